// rope: ropes with a loose overhand knot that is pulled tight. The one scene that is simulated.
#include "catena/core/motion/rope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/motion/knot.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

struct RopeSpec {
  SceneSetup setup;
  std::uint32_t spheres_a_rope, frames;
  double stiffness, step, duration;
  std::uint64_t seed;
  std::string variant;
};

/// n spheres as ropes side by side, the last one shorter. Two of full length are simulated, and the shorter
/// one; the others move like one of those two, so that the motion costs no more than that of three ropes. It
/// is simulated as far as a frame is asked for.
class RopeScene final : public Animation {
 public:
  explicit RopeScene(RopeSpec spec) : spec_(std::move(spec)) {
    const std::uint32_t n = spec_.setup.n(), full = n / spec_.spheres_a_rope, rest = n % spec_.spheres_a_rope;
    for (std::uint32_t k = 0; k < full; ++k) first_.push_back(k * spec_.spheres_a_rope);
    const bool shorter = rest > 0 || n == 0;
    if (shorter) first_.push_back(n - rest);
    ropes_ = static_cast<std::uint32_t>(first_.size());
    first_.push_back(n);
    columns_ = std::max(1u, static_cast<std::uint32_t>(std::ceil(std::sqrt(1.0 * ropes_))));

    twins_ = std::min(full, 2u);
    Random random(spec_.seed);
    start_.first = {0};
    for (std::uint32_t k = 0; k < twins_; ++k) add_model(k, random);
    if (shorter) add_model(full, random);
    frames_.push_back(start_.position);
    still_ = Chain(placed(0), {first_, {}}, motion::rope_neighbours(spec_.setup.spacing()));
  }

  std::uint32_t frames() const override { return spec_.frames; }

  Chain frame(std::uint32_t f) const override {
    if (f >= spec_.frames) throw std::out_of_range("rope: no such frame");
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      while (frames_.size() <= f) simulate_frame();
    } catch (...) {  // within a step, or between the steps of a frame: the motion begins anew
      motion_.reset();
      frames_.resize(1);
      throw;
    }
    return still_.moved(placed(f));
  }

 private:
  /// A rope that is simulated: where it lies in the simulation and in the scene.
  struct Model {
    std::uint32_t first;
    Vec3 root;
  };

  Vec3 root(std::uint32_t rope) const {
    const double middle = (columns_ - 1) / 2.0;
    return {0, motion::knot_room * (rope % columns_ - middle),
            motion::knot_room * (rope / columns_ - middle)};
  }
  const Model& model(std::uint32_t rope) const {
    const bool shorter = first_[rope + 1] - first_[rope] < spec_.spheres_a_rope;
    return shorter ? models_.back() : models_[rope % twins_];
  }
  void add_model(std::uint32_t rope, Random& random) {
    models_.push_back({start_.first.back(), root(rope)});
    motion::add_knotted_rope(start_, first_[rope + 1] - first_[rope], spec_.setup.spacing(), root(rope),
                             random);
  }

  std::vector<Sphere> placed(std::uint32_t f) const {
    std::vector<Sphere> spheres;
    spheres.reserve(spec_.setup.n());
    for (std::uint32_t k = 0; k < ropes_; ++k) {
      const Vec3 aside = root(k) - model(k).root;
      const auto own = frames_[f].begin() + model(k).first;
      for (std::uint32_t i = 0; i < first_[k + 1] - first_[k]; ++i)
        spheres.push_back(spec_.setup.place(own[i] + aside));
    }
    return spheres;
  }

  void simulate_frame() const {
    if (!motion_) {
      motion::RopeSettings settings;
      settings.stretching = spec_.stiffness;
      settings.spacing = spec_.setup.spacing();
      motion_.emplace(
          settings, start_, [this](const Vec3& p) { return spec_.setup.place(p); },
          StrategyRegistry::instance().make(spec_.variant));
    }
    const double interval = spec_.duration / (spec_.frames - 1);
    const auto steps = static_cast<std::uint64_t>(std::ceil(interval / spec_.step * (1 - 1e-12)));
    for (std::uint64_t s = 0; s < steps; ++s)
      if (!motion_->step(interval / static_cast<double>(steps)))
        throw InputError(fmt::format(
            "scene rope: the motion diverges, or leaves binary32, before frame {}; lower step={:g} or scale",
            frames_.size(), spec_.step));
    frames_.push_back(motion_->positions());
  }

  RopeSpec spec_;
  std::uint32_t ropes_ = 0, columns_ = 1, twins_ = 0;
  std::vector<std::uint32_t> first_;  // ropes + 1 offsets
  std::vector<Model> models_;
  motion::RopeMotion::Start start_;
  Chain still_;

  mutable std::mutex mutex_;
  mutable std::optional<motion::RopeMotion> motion_;
  mutable std::vector<std::vector<Vec3>> frames_;  // positions of the models
};

std::vector<std::string> variant_names() {
  std::vector<std::string> names;
  for (const VariantInfo& info : StrategyRegistry::instance().variants(true)) names.push_back(info.name);
  return names;
}

const RegisterScene registered{
    {"rope",
     "ropes, simulated, with a loose overhand knot that is pulled tight",
     {{"spacing", "1", "distance of neighbours along the rope, in radii"},
      {"rope", "120", "spheres a rope; those beyond two ropes repeat their motion"},
      {"stiffness", "1e4", "tension at a strain of 1, over the force that pulls"},
      {"frames", "41", "frames, the first of them at rest"},
      {"duration", "100",
       "time of the last frame; in one unit the pull moves a rope of one radius, from rest, by "
       "half of it"},
      {"step", "0.5", "time step at most"},
      {"variant", "aCPU2+CPU2",
       "finds the contacts that the motion answers to; a wrong one lets the rope "
       "through itself"},
      {"seed", "1", "of the first velocities"}},
     "as the knot tightens, contacts come to lie along whole stretches, and every pair of a stretch is near "
     "to "
     "touching; a pair lost is a rope that passes through itself later",
     {"stiffness=1e2", "stiffness=1e6", "stiffness=1e9", "offset=1e7"}},
    [](const Parameters& parameters) {
      constexpr auto most = ~std::uint64_t{0};
      return std::make_unique<RopeScene>(
          RopeSpec{SceneSetup("rope", parameters),
                   static_cast<std::uint32_t>(parameters.unsigned_integer("rope", 1, 1'000'000)),
                   static_cast<std::uint32_t>(parameters.unsigned_integer("frames", 1, 1'000'000)),
                   parameters.real("stiffness", 1, 1e12), parameters.real("step", 1e-6, 1e6),
                   parameters.real("duration", 1e-6, 1e6), parameters.unsigned_integer("seed", 0, most),
                   parameters.choice("variant", variant_names())});
    }};

}  // namespace
}  // namespace catena

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catena/core/strategy/keeps_answer.h"
#include "catena/properties/property.h"
#include "catena/reference/compare.h"

namespace catena::properties {
namespace {

struct Frame {
  std::string name;
  Case test;
  bool told;                        ///< update is told what moved
  std::vector<SphereRange> ranges;  ///< then this
  std::int64_t shift = 0;           ///< or this
};

/// A film of one chain: each frame from the last one.
class Film {
 public:
  explicit Film(const Chain& chain)
      : chain_(chain), spheres_(chain.spheres().begin(), chain.spheres().end()), n_(chain.size()) {}

  void still(bool told) { add("unmoved", told, {}); }

  /// Two stretches, one of them the last spheres, change places with others.
  void parts(bool told, std::uint32_t by) {
    const std::vector<Sphere> before = spheres_;
    const std::uint32_t a = n_ / 5, b = std::max(a, n_ / 5 + std::max(1u, n_ / 7)),
                        c = n_ - std::max(1u, n_ / 9);
    std::vector<SphereRange> ranges;
    for (const auto& [begin, end] : {SphereRange{a, std::min(b, c)}, SphereRange{c, n_}})
      if (begin < end) ranges.push_back({begin, end});
    for (const SphereRange& range : ranges)
      for (std::uint32_t i = range.begin; i < range.end; ++i) spheres_[i] = before[(i + by) % n_];
    add("parts", told, std::move(ranges));
  }

  /// One sphere is put where another is.
  void lone(std::uint32_t i) {
    spheres_[i] = spheres_[(i + n_ / 2) % n_];
    add("a lone sphere", false, {});
  }

  /// A window that moves on; what comes in lies where the other end was. `spoilt`: in all but one sphere,
  /// which is put onto another.
  void shift(std::int64_t s, bool spoilt, bool told = false) {
    const auto by = static_cast<std::uint32_t>(s < 0 ? n_ - static_cast<std::uint32_t>(-s) % n_ : s % n_);
    std::rotate(spheres_.begin(), spheres_.begin() + by, spheres_.end());
    if (spoilt) spheres_[n_ / 2] = spheres_[n_ / 8];
    add(spoilt ? "shift but for a sphere" : "shift", false, {});
    if (told) frames_.back().shift = s, frames_.back().name = "told shift";
  }

  /// Every other sphere goes one way, the rest the other.
  void drift(float step) {
    for (std::uint32_t i = 0; i < n_; ++i) {
      const float by = i / 3 % 2 == 0 ? step : -step;
      nudge(spheres_[i].x, by), nudge(spheres_[i].y, by), nudge(spheres_[i].z, -by);
    }
    add("drift", false, {});
  }

  void grow(float factor) {
    for (Sphere& s : spheres_) nudge(s.radius, s.radius * (factor - 1));
    add(factor > 1 ? "growth" : "shrinking", false, {});
  }

  /// What follows a sphere turns about it by a right angle.
  void pivot() {
    const std::uint32_t at = n_ / 3;
    for (std::uint32_t i = at + 1; i < n_; ++i) {
      const float dx = spheres_[i].x - spheres_[at].x, dy = spheres_[i].y - spheres_[at].y;
      const float x = spheres_[at].x - dy, y = spheres_[at].y + dx;
      if (std::isfinite(x) && std::isfinite(y)) spheres_[i].x = x, spheres_[i].y = y;
    }
    add("pivot", false, {});
  }

  std::vector<Frame> take() { return std::move(frames_); }

 private:
  static void nudge(float& value, float by) {
    if (std::isfinite(value + by)) value += by;
  }
  void add(std::string name, bool told, std::vector<SphereRange> ranges) {
    frames_.push_back({std::move(name), Case::of(chain_.moved(spheres_)), told, std::move(ranges)});
  }

  const Chain& chain_;
  std::vector<Sphere> spheres_;
  const std::uint32_t n_;
  std::vector<Frame> frames_;
};

std::vector<Frame> film_of(const Chain& chain) {
  Film film(chain);
  if (chain.size() < 2) return film.take();
  std::vector<float> radii;
  for (const Sphere& s : chain.spheres()) radii.push_back(s.radius);
  std::ranges::nth_element(radii, radii.begin() + radii.size() / 2);
  const float radius = radii[radii.size() / 2];
  film.parts(true, chain.size() / 2), film.still(true), film.still(false);
  film.parts(false, chain.size() / 3), film.lone(chain.size() - 1),
      film.lone(std::min(15u, chain.size() - 1));
  film.shift(3, false), film.shift(3, true), film.shift(-2, false);
  film.shift(5, false, true), film.shift(-(chain.size() / std::int64_t{2}), false, true),
      film.shift(1, false, true);
  if (chain.size() > 64) return film.take();
  for (int k = 0; k < 12; ++k) film.drift(0.06f * radius);
  for (int k = 0; k < 6; ++k) film.grow(1.06f);
  for (int k = 0; k < 4; ++k) film.grow(0.85f);
  film.pivot(), film.still(false), film.parts(true, 1);
  return film.take();
}

/// Of frame after frame the answer is that of the frame, whatever is known of the ones before: some parts
/// move or none, the chain moves on along itself, spheres drift and grow, a part turns. For variants that use
/// what frames have in common, and say so by a parameter `frames`.
class Frames final : public Property {
 public:
  std::string name() const override { return "frame after frame"; }
  bool applies_to(const Subject& subject) const override {
    const auto& stages = subject.info.parts.stages;
    const StrategyInfo* const info =
        stages.size() == 1 ? StrategyRegistry::instance().find_strategy(stages[0].strategy) : nullptr;
    return subject.exact() && info != nullptr &&
           std::ranges::find(info->parameters, "frames", &ParameterInfo::name) != info->parameters.end();
  }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    using Want = Request::Want;
    const auto& frames = frames_(test, [&] { return film_of(test.chain); });
    enum class Pass {
      each,
      each_kept,
      every_third
    };  // each frame is searched, into the variant's own answer, or few are
    auto* const keeper = dynamic_cast<KeepsAnswer*>(&variant);
    for (const Pass pass : {Pass::each, Pass::each_kept, Pass::every_third}) {
      if (pass == Pass::each_kept && keeper == nullptr) continue;
      variant.prepare({.frames_follow = true});
      variant.build(test.chain);
      variant.find(test.chain, {}, found_);
      for (std::size_t k = 0; k < frames.size(); ++k) {
        const Frame& frame = frames[k];
        // Also of frames that are not searched more may be asked, or less.
        const bool less = pass == Pass::every_third && k % 3 != 2 && k / 3 % 2 == 1;
        variant.prepare({.want = less ? Want::any : Want::pairs, .frames_follow = true});
        variant.update(frame.test.chain, frame.told         ? Moved(frame.ranges)
                                         : frame.shift != 0 ? Moved::along(frame.shift)
                                                            : Moved());
        if (pass == Pass::every_third && k % 3 != 2) continue;
        if (pass == Pass::each_kept) {
          if (!reference::compare(frame.test.chain, frame.test.exact, keeper->find_kept(frame.test.chain, {}))
                   .right())
            return fmt::format("frame {}, {}: another answer where it is kept", k, frame.name);
          continue;
        }
        variant.find(frame.test.chain, {}, found_);
        if (!reference::compare(frame.test.chain, frame.test.exact, found_).right())
          return fmt::format("frame {}, {}: {} pairs, exactly {}", k, frame.name, found_.pair_count,
                             frame.test.exact.pairs.size());
        const std::vector<std::uint32_t> counts = found_.count;
        variant.find(frame.test.chain, {Want::counts}, found_);
        if (found_.count != counts) return fmt::format("frame {}, {}: other counts alone", k, frame.name);
        variant.find(frame.test.chain, {Want::any}, found_);
        if (found_.found != !frame.test.exact.pairs.empty())
          return fmt::format("frame {}, {}: yes or no is wrong", k, frame.name);
      }
    }
    variant.prepare({});
    return std::nullopt;
  }

 private:
  DerivedFrom<std::vector<Frame>> frames_;
  Collisions found_;
};

const RegisterProperty<Frames> registered;

}  // namespace
}  // namespace catena::properties

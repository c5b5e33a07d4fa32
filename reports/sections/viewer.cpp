#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "catena/core/commands/input_options.h"
#include "catena/core/error.h"
#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/input/input.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/shell_word.h"
#include "catena/reference/compare.h"
#include "catena/reference/find_in_box.h"
#include "catena/reports/base64.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

static_assert(std::endian::native == std::endian::little, "the viewer reads little-endian arrays");

using Json = nlohmann::ordered_json;

constexpr std::uint32_t frames_shown = 10;  ///< of an animation, spread evenly

std::string spheres_of(const Chain& chain) { return base64(chain.spheres()); }

/// The bounds of a tree by height: a parent is one above the higher of its children.
class Levels final : public SphereBoundsVisitor {
 public:
  explicit Levels(const Chain& chain) : chain_(chain) {}
  void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
              const Sphere64&) override {
    bound_[parent_id] = parent;
    children_[parent_id].push_back(child_id);
  }
  Json json() {
    std::map<std::uint32_t, std::vector<Sphere>> levels;
    levels[0].assign(chain_.spheres().begin(), chain_.spheres().end());
    for (const auto& [id, bound] : bound_)
      if (std::isfinite(bound.radius))
        levels[height(id)].push_back({static_cast<float>(bound.x), static_cast<float>(bound.y),
                                      static_cast<float>(bound.z), static_cast<float>(bound.radius)});
    Json list = Json::array();
    for (const auto& [level, spheres] : levels)
      list.push_back({{"level", level}, {"spheres", base64(std::span<const Sphere>(spheres))}});
    return list;
  }

 private:
  std::uint32_t height(std::uint32_t id) {
    if (id < chain_.size()) return 0;
    auto& known = height_[id];
    if (known == 0) {
      for (const std::uint32_t child : children_[id]) known = std::max(known, height(child));
      ++known;
    }
    return known;
  }

  const Chain& chain_;
  std::map<std::uint32_t, Sphere64> bound_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> children_;
  std::map<std::uint32_t, std::uint32_t> height_;
};

/// The tree of the first exact variant on the host that shows one.
Json levels_of(const Chain& chain, const Profile& profile) {
  for (const auto& info : exact_variants(profile)) {
    if (!info.has_tree || info.on_device()) continue;
    Json levels_shown;
    const bool shown = attempt(info.name, [&] {
      const auto variant = StrategyRegistry::instance().make(info.name);
      variant->build(chain);
      Levels levels(chain);
      variant->visit_bounds(levels);
      levels_shown = levels.json();
    });
    if (shown) return levels_shown;
  }
  return {};
}

/// Which pairs each rounded variant misses and invents.
Json wrong_answers(const Chain& chain, std::span<const PeriodicBox> boxes, std::uint32_t frame,
                   const reference::Answer& exact, const Profile& profile) {
  constexpr std::uint64_t pair_limit = 200'000;
  Json list = Json::array();
  for (const auto& info : profile.variants) {
    if (info.exact || info.peer) continue;
    if (info.all_pairs && chain.size() > 5000) continue;
    Collisions found;
    try {
      const bool answered = attempt(info.name, [&] {
        auto variant = StrategyRegistry::instance().make(info.name);
        go_to_frame(put_into_boxes(variant, boxes), boxes, frame);
        variant->build(chain);
        variant->find(chain, {.pair_limit = pair_limit}, found);
      });
      if (!answered) continue;
    } catch (const PairLimitExceeded&) {  // invents a flood
      continue;
    }
    std::ranges::sort(found.pairs);
    const auto without = [](const std::vector<Pair>& all, const std::vector<Pair>& those) {
      Json pairs = Json::array();
      std::vector<Pair> rest;
      std::ranges::set_difference(all, those, std::back_inserter(rest));
      for (const Pair& p : rest) pairs.push_back({p.i, p.j});
      return pairs;
    };
    Json missing = without(exact.pairs, found.pairs), invented = without(found.pairs, exact.pairs);
    if (missing.empty() && invented.empty()) continue;
    list.push_back({{"variant", info.name},
                    {"frame", frame},
                    {"missing", std::move(missing)},
                    {"invented", std::move(invented)}});
  }
  return list;
}

Json view(const bench::WorkloadSpec& shown, const Profile& profile) {
  const Input input = open_input(shown.input, shown.options);
  const std::uint32_t all = input.animation->frames();
  const std::uint32_t count = shown.all_frames ? std::min(frames_shown, all) : 1;
  Json frames = Json::array(), wrong = Json::array();
  Chain busiest;  // of the frames shown, the one with the most pairs, which the viewer shows first
  std::uint32_t busiest_frame = 0;
  std::uint64_t most = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t frame = count == 1 ? all / 2 : k * (all - 1) / (count - 1);
    const Chain chain = input.animation->frame(frame);
    const PeriodicBox* box = box_of(input.boxes, frame);
    const auto exact = reference::find_in(chain, box);
    Json stored{{"frame", frame},
                {"spheres", spheres_of(chain)},
                {"pairs", base64(std::span<const Pair>(exact.pairs))}};
    if (box) stored["box"] = {box->length[0], box->length[1], box->length[2], box->xy, box->xz, box->yz};
    frames.push_back(std::move(stored));
    for (auto& answer : wrong_answers(chain, input.boxes, frame, exact, profile))
      wrong.push_back(std::move(answer));
    if (k == 0 || exact.pair_count > most) busiest = chain, busiest_frame = frame, most = exact.pair_count;
  }
  auto strands = busiest.strands().first;
  strands.pop_back();
  Json closed = Json::array();
  for (std::size_t s = 0; s < strands.size(); ++s) closed.push_back(busiest.strands().closed[s] != 0);
  Json out{{"input", bench::label_of({shown.input, false, shown.options})},
           {"command", fmt::format("catena detect {}{} --frame {} --variant aCPU2+CPU2 --pairs pairs.csv",
                                   shell_word(shown.input), in_command(shown.options),
                                   count == 1 ? std::to_string(all / 2) : "all")},
           {"frames", std::move(frames)},
           {"strands", strands},
           {"closed", std::move(closed)}};
  if (input.boxes.empty())  // otherwise the tree is one of images, too
    if (Json levels = levels_of(busiest, profile); !levels.empty()) {
      out["tree_frame"] = busiest_frame;
      out["levels"] = std::move(levels);
    }
  if (!wrong.empty()) out["wrong"] = std::move(wrong);
  return out;
}

/// The chains that the viewer shows.
Json viewer(const Profile& profile) {
  Json list = Json::array();
  for (const auto& shown : profile.shown) list.push_back(view(shown, profile));
  return list;
}

const RegisterSection registered{"viewer", viewer};

}  // namespace
}  // namespace catena::reports

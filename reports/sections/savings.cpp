#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "catena/bench/timing/median_interval.h"
#include "catena/bench/timing/sampling.h"
#include "catena/core/input/input.h"
#include "catena/reports/faults.h"
#include "catena/reports/saving.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

using Json = nlohmann::ordered_json;
using Want = Request::Want;

/// A variant that stands built on a chain, and has searched it.
struct Standing {
  VariantInfo info;
  std::unique_ptr<Variant> variant;
};

std::vector<Pair> sorted_pairs(Variant& variant, const Chain& chain) {
  Collisions found;
  variant.find(chain, {}, found);
  std::ranges::sort(found.pairs);
  return found.pairs;
}

using Make = std::function<std::unique_ptr<Variant>(const std::string&)>;

std::vector<Standing> standing(const std::vector<VariantInfo>& infos, const Chain& chain,
                               bool VariantInfo::*kind, const Make& make) {
  std::vector<Standing> list;
  for (const auto& info : infos) {
    if (!(info.*kind)) continue;
    attempt(info.name, [&] {
      auto variant = make(info.name);
      variant->build(chain);
      sorted_pairs(*variant, chain);  // one that fails is left out here, not in the middle
      list.push_back({info, std::move(variant)});
    });
  }
  return list;
}

/// Update and find, wall time.
double whole_ms(Variant& variant, const Chain& chain, Collisions& found) {
  const Stopwatch watch;
  variant.update(chain);
  variant.find(chain, {}, found);
  return watch.ms();
}

/// Which of `runs` has the least median.
std::size_t quickest(const std::vector<std::vector<double>>& ms) {
  const auto median = [](const std::vector<double>& samples) {
    return bench::median_interval(samples).median;
  };
  return static_cast<std::size_t>(std::ranges::min_element(ms, {}, median) - ms.begin());
}

/// The quickest of these on this chain, tried a few times.
std::optional<std::size_t> quickest_of(const std::vector<Standing>& list, const Chain& chain,
                                       const Profile& profile) {
  if (list.empty()) return {};
  Collisions found;
  std::vector<std::function<double()>> runs;
  for (const auto& s : list)
    runs.emplace_back(
        [&] { return blaming(s.info.name, [&] { return whole_ms(*s.variant, chain, found); }); });
  return quickest(bench::interleave(runs, 5, profile.section_seconds / 4, profile.stopping.seed));
}

/// No hierarchy for short chains: the quickest tree against the quickest comparison of all pairs, over n.
void hierarchy(Json& rows, const Profile& profile) {
  for (const std::uint32_t n : profile.short_chains) {
    const std::string spec = fmt::format("path1:n={}", n);
    const Input input = open_input(spec);
    const Chain chain = input.animation->frame(input.animation->frames() / 2);
    const auto make = [](const std::string& name) { return StrategyRegistry::instance().make(name); };
    const auto trees = standing(exact_variants(profile), chain, &VariantInfo::has_tree, make);
    const auto all_pairs = standing(exact_variants(profile), chain, &VariantInfo::all_pairs, make);
    const auto tree = quickest_of(trees, chain, profile), pairs = quickest_of(all_pairs, chain, profile);
    if (!tree || !pairs) continue;
    Variant &with = *trees[*tree].variant, &without = *all_pairs[*pairs].variant;
    Collisions found;
    rows.push_back(saving(
        bench::label_of({spec}), "hierarchy",
        fmt::format("{} spheres: {} against {}", n, trees[*tree].info.name, all_pairs[*pairs].info.name),
        sorted_pairs(with, chain) == sorted_pairs(without, chain),
        [&] { return whole_ms(with, chain, found); }, [&] { return whole_ms(without, chain, found); },
        profile));
  }
}

/// The pair list when counts suffice, and counts when a yes or no does.
void pair_list(Json& rows, const Profile& profile) {
  for (const auto& spec : profile.wants_inputs) {
    const auto work = bench::workload(spec);
    const Chain& chain = work->chains.front();
    const auto make = [&](const std::string& variant) { return work->make(variant); };
    const auto trees = standing(exact_variants(profile), chain, &VariantInfo::has_tree, make);
    const auto best = quickest_of(trees, chain, profile);
    if (!best) continue;
    Variant& variant = *trees[*best].variant;
    Collisions all, less;
    const auto find = [&](Want want, Collisions& found) {
      return [&variant, &chain, &found, want] {
        variant.find(chain, {.want = want}, found);
        return variant.timings().find_ms;
      };
    };
    find(Want::pairs, all)(), find(Want::counts, less)();
    const bool same_counts = all.count == less.count && all.pair_count == less.pair_count;
    const auto& name = trees[*best].info.name;
    rows.push_back(saving(work->label, "pair list", fmt::format("only counts are wanted ({})", name),
                          same_counts, find(Want::pairs, all), find(Want::counts, less), profile));
    find(Want::any, less)();
    rows.push_back(saving(work->label, "counts and pair list",
                          fmt::format("only yes or no is wanted ({})", name), less.found == all.found,
                          find(Want::pairs, all), find(Want::any, less), profile));
  }
}

/// A rebuild for a frame that did not move, and a new variant for one that did.
void rebuild(Json& rows, const Profile& profile) {
  for (const auto& spec : profile.coherent_inputs) {
    const auto work = bench::workload(spec);
    const Chain& chain = work->chains.front();
    const auto make = [&](const std::string& variant) { return work->make(variant); };
    const auto trees = standing(exact_variants(profile), chain, &VariantInfo::has_tree, make);
    const auto best = quickest_of(trees, chain, profile);
    if (!best) continue;
    Variant& variant = *trees[*best].variant;
    const auto& name = trees[*best].info.name;
    Collisions found;
    const auto before = sorted_pairs(variant, chain);
    variant.update(chain);
    rows.push_back(saving(
        work->label, "rebuild", fmt::format("the frame did not move ({})", name),
        sorted_pairs(variant, chain) == before, [&] { return whole_ms(variant, chain, found); },
        [&] {
          const Stopwatch watch;
          variant.find(chain, {}, found);
          return watch.ms();
        },
        profile));
    const auto anew = make(name);
    anew->build(chain);
    rows.push_back(saving(
        work->label, "new build", fmt::format("update() reuses what stands ({})", name),
        sorted_pairs(*anew, chain) == before,
        [&] {
          const auto fresh = make(name);
          const Stopwatch watch;
          fresh->build(chain);
          return watch.ms();
        },
        [&] {
          const Stopwatch watch;
          variant.update(chain);
          return watch.ms();
        },
        profile));
  }
}

/// What each scene could do without, and what that saves.
Json savings(const Profile& profile) {
  Json rows = Json::array();
  hierarchy(rows, profile);
  pair_list(rows, profile);
  rebuild(rows, profile);
  add_planned_savings(rows, profile);
  return rows;
}

const RegisterSection registered{"savings", savings};

}  // namespace
}  // namespace catena::reports

#include "catena/bench/stability/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/commands/show_warnings.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"
#include "catena/reference/exact_gap.h"

namespace catena::bench {
namespace {

constexpr std::uint64_t pair_limit = std::uint64_t{1} << 24;  ///< beyond, counts are compared

double seconds_on_first(Variant& variant, const Chain& chain, std::uint32_t n) {
  const auto spheres = chain.spheres().first(n);
  const Chain beginning({spheres.begin(), spheres.end()}, {}, {});
  Collisions found;
  double least = std::numeric_limits<double>::infinity(), all = 0;
  for (int round = 0; round < 5 && all < 0.1; ++round) {  // the least of a few, as short times are noisy
    const Stopwatch watch;
    variant.build(beginning);
    variant.find(beginning, {Request::Want::counts}, found);
    least = std::min(least, watch.ms() / 1000);
    all += watch.ms() / 1000;
  }
  return least;
}

/// Why a variant is left out on this chain; empty when it is not.
std::string too_much(const VariantInfo& info, const Chain& chain, const StabilityLimits& limits) {
  if (chain.size() > limits.all_pairs && info.all_pairs)
    return fmt::format("O(n^2): left out above {} spheres", limits.all_pairs);
  if (estimated_seconds(info.name, chain, limits.seconds) > limits.seconds)
    return fmt::format("likely to take longer than {:g} s, by its growth; see --seconds", limits.seconds);
  return "";
}

}  // namespace

double estimated_overlaps(const Chain& chain) {
  const std::uint32_t n = chain.size(), asked = std::min(n, 256u);
  std::uint64_t overlaps = 0;
  // The middle of each part: scenes have what is unlike the rest at an end.
  for (std::uint32_t k = 0; k < asked; ++k) {
    const Sphere& a = chain[static_cast<std::uint32_t>((2 * std::uint64_t{k} + 1) * n / (2 * asked))];
    for (const Sphere& b : chain.spheres()) overlaps += reference::GapEstimate::of(a, b).gap <= 0;
  }
  // Each sphere met itself too, and each pair counts from both ends.
  return asked == 0 ? 0 : (static_cast<double>(overlaps) / asked - 1) * n / 2;
}

double estimated_seconds(const std::string& name, const Chain& chain, double enough) {
  if (chain.size() < 50'000) return 0;
  const auto variant = blaming(name, [&] { return StrategyRegistry::instance().make(name); });
  try {
    const double shorter = seconds_on_first(*variant, chain, chain.size() / 16);
    if (16 * shorter > enough) return 16 * shorter;
    const double longer = seconds_on_first(*variant, chain, chain.size() / 4);
    return longer * std::clamp(longer / shorter, 4.0, 16.0);
  } catch (...) {
    return 0;  // the measurement itself says why
  }
}

std::vector<Cell> measure_scene(const std::string& spec, const std::vector<std::string>& variants,
                                const StabilityLimits& limits,
                                const std::function<void(const std::string&)>& before) {
  const Input input = open_input(spec, limits.input);
  show_warnings(input);
  std::vector<VariantInfo> infos;
  for (const auto& name : variants) infos.push_back(StrategyRegistry::instance().describe(name));
  std::vector<Cell> cells;
  const auto leave_out = [&](const Chain& chain, const std::string& why) {
    for (const VariantInfo& info : infos) {
      if (before) before(info.name);
      cells.push_back(unavailable(spec, info, chain, {}, why));
      cells.back().answered = false;
    }
    return cells;
  };
  Chain chain;
  try {
    chain = input.animation->frame(input.animation->frames() / 2);
  } catch (const InputError& why) {  // a simulated scene may not get that far at every size
    return leave_out(chain, why.what());
  }
  if (const double overlaps = estimated_overlaps(chain); overlaps > limits.overlaps)
    return leave_out(
        chain,
        fmt::format("about {:.0e} overlapping spheres, neighbours included; see --overlaps", overlaps));
  const reference::Answer exact = reference::exact_answer(chain, pair_limit);
  for (const VariantInfo& info : infos) {
    if (before) before(info.name);
    try {
      const auto variant = blaming(info.name, [&] { return StrategyRegistry::instance().make(info.name); });
      const std::string why = too_much(info, chain, limits);
      cells.push_back(why.empty() ? measure(spec, info, *variant, chain, exact)
                                  : unavailable(spec, info, chain, exact, why));
    } catch (const CapacityError& why) {
      cells.push_back(unavailable(spec, info, chain, exact, why.what()));
    }
  }
  return cells;
}

}  // namespace catena::bench

#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "catena/bench/stability/cell.h"
#include "catena/core/input/input.h"

namespace catena::bench {

/// What a cell of the stability matrix may cost; what is likely to cost more is left out, with the reason.
struct StabilityLimits {
  double seconds = 60;  ///< of one variant on one scene
  /// Overlapping spheres of a chain, neighbours included: every search must meet each of them.
  double overlaps = 2e8;
  std::uint32_t all_pairs = 20'000;  ///< spheres above which O(n^2) variants are left out
  InputOptions input{};              ///< what is said of the inputs
};

/// How many pairs of spheres overlap, neighbours included: from 256 spheres spread evenly over the chain,
/// each against all. O(n).
double estimated_overlaps(const Chain& chain);

/// How long a variant is likely to take to build and find: its times on the first n/16 and n/4 spheres,
/// continued by their growth. Once it is sure to pass `enough` it is not asked for more. 0 for a chain too
/// short to tell (n < 50,000).
double estimated_seconds(const std::string& variant, const Chain& chain, double enough);

/// One line of the stability matrix: the middle frame of an input, under every variant. `before` is called
/// with the name of each. Throws InputError.
std::vector<Cell> measure_scene(const std::string& input, const std::vector<std::string>& variants,
                                const StabilityLimits& limits = {},
                                const std::function<void(const std::string&)>& before = {});

}  // namespace catena::bench

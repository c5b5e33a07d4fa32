#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/bench/timing/google/rounds.h"
#include "catena/bench/timing/workload.h"
#include "catena/core/strategy/registry.h"

namespace catena::reports {

/// How much to measure, and of what.
struct Profile {
  std::string name;  ///< quick, full, paper; custom once the user chose inputs or variants
  std::vector<bench::WorkloadSpec> inputs;  ///< timed, counted
  /// Of which the searches that count their steps are counted and timed a few times, and nothing else is
  /// measured: longer than the rest have time for.
  std::vector<bench::WorkloadSpec> long_inputs;
  std::vector<VariantInfo> variants;  ///< available here
  std::string filter;                 ///< on the names of timed cases; see bench::filtered
  bench::Stopping stopping;
  /// The sections come first and leave the rest of this to the timing, but at least 20 s; 0: no limit on the
  /// whole.
  double whole_seconds = 0;
  /// Above, O(n^2) variants on the host are not timed.
  std::uint32_t most_all_pairs = 20'000;

  double section_seconds = 5;  ///< for the repetitions of each of the smaller timed sections
  std::size_t section_rounds = 15;
  std::uint32_t stability_n = 0;              ///< spheres of its scenes; 0: no stability matrix
  std::vector<double> motion_stiffnesses;     ///< of the stiff rope
  std::vector<double> motion_steps;           ///< of its motions; empty: they are left out
  std::vector<double> motion_offsets;         ///< of the stored chain, in radii
  std::size_t motion_starts = 0;              ///< perturbed starts of each motion
  double motion_seconds = 0;                  ///< no motion of it begins later
  std::vector<std::uint32_t> keyframe_sizes;  ///< of both paths, whose pairs are counted in every keyframe
  std::uint64_t copy_bytes = 0;               ///< of the copy that measures the bandwidth; 0: it is left out
  std::vector<std::string> tubes;             ///< of the work-precision diagram
  std::vector<double> tube_spacings;          ///< in radii
  double tube_tolerance = 0.01;  ///< the share of the radius whose number of spheres is marked there
  std::vector<std::string> examine_settings;  ///< of rod, path1 and yarn
  std::vector<bench::WorkloadSpec> shown;     ///< in the viewer; all frames: ten of them
  std::vector<bench::WorkloadSpec> wants_inputs, coherent_inputs;
  std::vector<bench::WorkloadSpec> regret_inputs;  ///< on which auto is held against the quickest variant
  std::vector<std::string> planned_inputs;         ///< on which what auto leaves out is done all the same
  int judged_steps = 0;  ///< of the lattice walks that others counted; 0: nothing is judged from outside
  std::uint32_t judged_side = 0;   ///< points along an axis of the chain whose pairs a formula knows
  std::uint32_t judged_n = 0;      ///< spheres of the longest chain whose node pairs are counted
  std::uint64_t judged_moves = 0;  ///< pivots of each walk whose exponent is estimated
  struct RankChain {
    std::string input;
    unsigned most;  ///< ranks
  };
  std::vector<RankChain> rank_chains;       ///< shared out among ranks
  std::vector<std::uint32_t> short_chains;  ///< n of path1 at which a hierarchy is weighed against all pairs
  bench::WorkloadSpec animation_input;      ///< no name: none
  std::uint32_t animation_step = 1;         ///< every so manieth frame
};

/// The profile of that name with every variant that is available here. Throws InputError naming what there
/// is.
Profile profile_named(const std::string& name);

/// Those of the profile's variants that are exact and on the host or device alike.
std::vector<VariantInfo> exact_variants(const Profile& profile);

}  // namespace catena::reports

#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/timing/workload.h"
#include "catena/core/strategy/variant_info.h"

namespace catena::bench {

/// What the variant auto took of a chain beside the quickest single variant: build and find, from nothing to
/// the pairs.
struct Regret {
  std::string input = {};   ///< SCENE/n:N, see label_of
  std::uint64_t n = 0;      ///< spheres
  std::string chosen = {};  ///< what auto took
  std::string best = {};    ///< the quickest of the others
  bool processor = true;    ///< its time, of all threads; else by the wall clock, as auto took several
  std::vector<double> auto_ms = {}, best_ms = {};  ///< in random turns

  std::string left_out = {};  ///< why nothing was measured; empty: it was

  double auto_median() const;
  double best_median() const;
  double ratio() const { return auto_median() / best_median(); }
};

struct RegretEffort {
  double seconds = 1;       ///< for the two, and as long to find the quickest
  std::size_t rounds = 31;  ///< at most
  double least_ms = 0.1;    ///< a sample repeats what is quicker for so long
  std::uint64_t seed = 1;   ///< of the turns
};

/// Of all, those that auto is held against: exact, of the host, and no emulation of a device.
std::vector<VariantInfo> regret_variants(std::vector<VariantInfo> all);

/// The regret on the first chain of an input, after every answer was held against the exact reference. Which
/// variant is the quickest is found by some runs of each; one that takes twice the least is not tried again.
/// Throws VariantThrew, and Error of a wrong answer.
Regret regret(const WorkloadSpec& spec, const std::vector<VariantInfo>& others, const RegretEffort& effort);

/// Every scene of the registry at n spheres.
std::vector<WorkloadSpec> all_scenes(std::uint32_t n);

/// The line of `catena regret --json`, and the row of the run file.
nlohmann::ordered_json to_json(const Regret& regret);

}  // namespace catena::bench

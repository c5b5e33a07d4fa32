#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/timing/workload.h"
#include "catena/core/strategy/variant_info.h"

namespace catena::bench {

/// What the variant auto took of a chain beside the quickest single variant: build and find, from nothing to
/// the pairs. Of one chain alone its first choice counts, as each is made anew; where one searches again and
/// again, what it settled on.
struct Regret {
  std::string input = {};   ///< SCENE/n:N, see label_of
  std::uint64_t n = 0;      ///< spheres
  std::string first = {};   ///< what auto took at once
  std::string chosen = {};  ///< and in the end, mostly
  std::string best = {};    ///< the quickest of the others
  bool processor = true;    ///< its time, of all threads; else by the wall clock, as auto took several
  std::vector<double> first_ms = {}, best_first_ms = {};  ///< made anew for each search; all in random turns
  std::vector<double> auto_ms = {}, best_ms = {};         ///< after many searches

  std::string left_out = {};  ///< why nothing was measured; empty: it was

  double first_median() const;
  double best_first_median() const;
  double first_ratio() const { return first_median() / best_first_median(); }
  double auto_median() const;
  double best_median() const;
  double ratio() const { return auto_median() / best_median(); }
};

struct RegretEffort {
  double seconds = 1;       ///< for the four, and as long to find the quickest
  std::size_t rounds = 31;  ///< at most
  double least_ms = 0.1;    ///< a sample repeats what is quicker for so long
  std::uint64_t seed = 1;   ///< of the turns
};

/// Of all, those that auto is held against: exact, of the host, and no emulation of a device.
std::vector<VariantInfo> regret_variants(std::vector<VariantInfo> all);

/// The regret of `of` on the first chain of an input, after every answer was held against the exact
/// reference. Which variant is the quickest is found by some runs of each; one that takes twice the least is
/// not tried again. Throws VariantThrew, and Error of a wrong answer.
Regret regret(const WorkloadSpec& spec, const std::vector<VariantInfo>& others, const RegretEffort& effort,
              const std::string& of = "auto");

/// Every scene of the registry at n spheres.
std::vector<WorkloadSpec> all_scenes(std::uint32_t n);

/// The line of `catena regret --json`, and the row of the run file.
nlohmann::ordered_json to_json(const Regret& regret);

}  // namespace catena::bench

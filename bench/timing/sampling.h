#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace catena::bench {

/// When to stop taking samples.
struct Stopping {
  double seconds = 100;  ///< no sample begins later
  double share = 0.05;   ///< a run is done when the interval of its median is narrower than this share of it
  std::size_t most_samples = 100;
  double least_ms = 5;  ///< a sample repeats what is quick for about so long; where Google Benchmark samples
  std::uint64_t seed = 1;        ///< of the order
  std::size_t least_rounds = 0;  ///< made whatever the time
  bool whole_rounds = false;     ///< a round that has begun is finished: every run has equally many samples
};

/// Runs that keep together: of each group its units, of each unit its runs. A round goes through the groups
/// in random order, in each through the units in random order, and through the runs of a unit as they stand.
using Groups = std::vector<std::vector<std::vector<std::size_t>>>;

/// A sample that is due.
struct Turn {
  std::size_t run = 0, round = 0;
  std::size_t place = 0, places = 1;  ///< in the round, and how many that has
};

struct Samples {
  std::vector<std::vector<double>> ms;  ///< of each run, in the order in which they were taken
  std::size_t rounds = 0;               ///< begun
  std::vector<bool> failed;             ///< of each run; empty: none
};

/// The one loop that samples. Each round takes one sample of every run that is not done, in a fresh random
/// order. `take` gives milliseconds, or nothing when the run failed, which is then not asked again. `earlier`
/// is what was sampled before an interruption: it counts, and is a part of what is returned.
Samples sample_in_rounds(Groups groups, const Stopping& stopping,
                         const std::function<std::optional<double>(const Turn&)>& take, Samples earlier = {});

/// Whether these samples are enough: the interval of their median is narrower than `share` of it.
bool narrow(const std::vector<double>& ms, double share);

/// Runs every one of `runs` once a round, each by itself, until there are `most_rounds` or, after at least
/// three, `seconds` have passed. Each returns its milliseconds; result[k] are those of run k in order,
/// equally many of all.
std::vector<std::vector<double>> interleave(const std::vector<std::function<double()>>& runs,
                                            std::size_t most_rounds, double seconds, std::uint64_t seed);

}  // namespace catena::bench

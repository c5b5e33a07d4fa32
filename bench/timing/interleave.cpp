#include "catena/bench/timing/interleave.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "catena/core/strategy/timings.h"

namespace catena::bench {

std::vector<std::vector<double>> interleave(const std::vector<std::function<double()>>& runs,
                                            std::size_t most_rounds, double seconds, std::uint64_t seed) {
  constexpr std::size_t least_rounds = 3;
  std::vector<std::vector<double>> ms(runs.size());
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  const Stopwatch watch;
  for (std::size_t round = 0; round < most_rounds; ++round) {
    if (round >= least_rounds && watch.ms() > 1000 * seconds) break;
    std::ranges::shuffle(order, random);
    for (const std::size_t k : order) ms[k].push_back(runs[k]());
  }
  return ms;
}

}  // namespace catena::bench

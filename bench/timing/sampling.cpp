#include "catena/bench/timing/sampling.h"

#include <algorithm>
#include <random>

#include "catena/bench/timing/median_interval.h"
#include "catena/core/strategy/timings.h"

namespace catena::bench {
namespace {

/// The runs of a round that are not done, in its random order.
std::vector<std::size_t> shuffled(Groups& groups, const std::vector<bool>& done, std::mt19937_64& random) {
  std::vector<std::size_t> order;
  std::ranges::shuffle(groups, random);
  for (auto& units : groups) {
    std::ranges::shuffle(units, random);
    for (const auto& unit : units)
      for (const std::size_t run : unit)
        if (!done[run]) order.push_back(run);
  }
  return order;
}

std::size_t runs_in(const Groups& groups) {
  std::size_t runs = 0;
  for (const auto& units : groups)
    for (const auto& unit : units) runs += unit.size();
  return runs;
}

}  // namespace

bool narrow(const std::vector<double>& ms, double share) {
  return share > 0 && !ms.empty() && median_interval(ms).relative_width() < share;
}

Samples sample_in_rounds(Groups groups, const Stopping& stopping,
                         const std::function<std::optional<double>(const Turn&)>& take, Samples samples) {
  const Stopwatch watch;
  std::mt19937_64 random(stopping.seed + samples.rounds);
  const std::size_t runs = runs_in(groups);
  samples.ms.resize(runs);
  samples.failed.resize(runs);
  std::vector<bool> done(runs);
  const auto enough = [&](std::size_t run) {
    const auto& ms = samples.ms[run];
    return samples.failed[run] || ms.size() >= stopping.most_samples || narrow(ms, stopping.share);
  };
  for (std::size_t run = 0; run < runs; ++run) done[run] = enough(run);
  const auto late = [&](const Turn& turn) {
    return turn.round >= stopping.least_rounds && (turn.place == 0 || !stopping.whole_rounds) &&
           watch.ms() > 1000 * stopping.seconds;
  };
  for (;;) {
    const auto order = shuffled(groups, done, random);
    if (order.empty()) return samples;
    for (Turn turn{.round = samples.rounds, .places = order.size()}; turn.place < order.size();
         ++turn.place) {
      if (late(turn)) return samples;
      samples.rounds = turn.round + 1;
      turn.run = order[turn.place];
      const auto taken = take(turn);
      if (taken) samples.ms[turn.run].push_back(*taken);
      samples.failed[turn.run] = !taken;
      done[turn.run] = enough(turn.run);
    }
  }
}

std::vector<std::vector<double>> interleave(const std::vector<std::function<double()>>& runs,
                                            std::size_t most_rounds, double seconds, std::uint64_t seed) {
  Groups groups;
  for (std::size_t run = 0; run < runs.size(); ++run) groups.push_back({{run}});
  const Stopping stopping{.seconds = seconds,
                          .share = 0,
                          .most_samples = most_rounds,
                          .seed = seed,
                          .least_rounds = 3,
                          .whole_rounds = true};
  return sample_in_rounds(std::move(groups), stopping, [&](const Turn& turn) { return runs[turn.run](); }).ms;
}

}  // namespace catena::bench

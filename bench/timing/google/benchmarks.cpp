#include "catena/bench/timing/google/benchmarks.h"

#include <algorithm>
#include <limits>

#include "catena/core/error.h"

namespace catena::bench {

void measure(benchmark::State& state, Trial& trial, Stage stage) {
  if (const auto& why = trial.prepare(); !why.empty()) return state.SkipWithError(why.c_str());
  double least_ms = std::numeric_limits<double>::infinity();
  for (auto iteration : state) {
    (void)iteration;
    double ms;
    try {
      ms = trial.run(stage);
    } catch (const Error& thrown) {
      state.SkipWithError(thrown.what());
      return;
    }
    least_ms = std::min(least_ms, ms);
    state.SetIterationTime(ms / 1000);
  }
  state.counters["pairs"] = static_cast<double>(trial.pairs());
  // Where they are 0, too: that nothing was wrong is something to say.
  state.counters["missing"] = static_cast<double>(trial.missing());
  state.counters["invented"] = static_cast<double>(trial.invented());
  state.counters["transfer_ms"] = trial.transfer_ms();
  if (!trial.spec().all_frames)
    state.counters["least_ms"] = least_ms;  // of frames that differ it would be the easiest
}

void register_benchmark(const Case& c, std::shared_ptr<Trial> trial) {
  benchmark::RegisterBenchmark(
      c.name().c_str(),
      [trial = std::move(trial), stage = c.stage](benchmark::State& state) { measure(state, *trial, stage); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace catena::bench

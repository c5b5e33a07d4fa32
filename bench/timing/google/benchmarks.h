#pragma once
#include <benchmark/benchmark.h>

#include <memory>

#include "catena/bench/timing/cases.h"

namespace catena::bench {

/// Registers one case with Google Benchmark under its name, in manual time and milliseconds. A robust variant
/// that differs from the exact reference is an error; a rounded one reports `missing` and `invented`. Cases
/// of one variant and input may share their trial.
void register_benchmark(const Case& c, std::shared_ptr<Trial> trial);

/// What the registered function does: prepares the trial and times the stage.
void measure(benchmark::State& state, Trial& trial, Stage stage);

}  // namespace catena::bench

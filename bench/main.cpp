#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "catena/bench/benchmarks.h"
#include "catena/core/environment.h"

/// catena_bench: Google Benchmark's own options and JSON; --benchmark_filter picks by scene/n/variant/stage.
int main(int argc, char** argv) {
  const auto facts = catena::environment();
  if (facts.at("build type") != "Release") {
    fmt::print(stderr,
               "catena_bench: this is a {} build; its times mean nothing. Configure with --preset release.\n",
               facts.at("build type"));
    return 2;
  }
  for (const auto& [key, value] : facts) benchmark::AddCustomContext(key, value);
  catena::bench::register_benchmarks();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "catena/bench/benchmarks.h"
#include "catena/core/environment.h"

/// catena_bench: Google Benchmark's own options and JSON; --benchmark_filter picks by scene/n/variant/stage.
/// One option of its own: --flush-cache empties the device's cache before every sample.
int main(int argc, char** argv) {
  const auto facts = catena::environment();
  if (facts.at("build type") != "Release") {
    fmt::print(stderr,
               "catena_bench: this is a {} build; its times mean nothing. Configure with --preset release.\n",
               facts.at("build type"));
    return 2;
  }
  for (const auto& [key, value] : facts) benchmark::AddCustomContext(key, value);
  const auto flush = std::find(argv, argv + argc, std::string_view("--flush-cache"));
  const bool flush_cache = flush != argv + argc;
  if (flush_cache) std::rotate(flush, flush + 1, argv + argc--);
  benchmark::AddCustomContext("device cache", flush_cache ? "flushed before every sample" : "warm");
  catena::bench::register_benchmarks(flush_cache);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

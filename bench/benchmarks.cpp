#include "catena/bench/benchmarks.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>

#include "catena/bench/workload.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/compare.h"

namespace catena::bench {
namespace {

constexpr std::array scenes{"path1", "path2", "yarn"};
constexpr std::array<std::uint32_t, 11> sizes{1000,    10'000,  20'000,    30'000,    40'000,    50'000,
                                              100'000, 150'000, 1'000'000, 3'000'000, 10'000'000};
/// Beyond, O(n^2) strategies are left out: on the host, and on a device.
constexpr std::uint32_t most_all_pairs_host = 20'000, most_all_pairs_device = 150'000;

enum class Stage { build, find, whole };

struct Case {
  std::string scene;
  std::uint32_t n;
  VariantInfo variant;
  Stage stage;
  bool flush_cache;
};

/// Empty when the answer is right, or wrong as rounded arithmetic may be; that is then reported in counters.
std::string wrong(const Case& c, const Workload& work, const Collisions& found, benchmark::State& state) {
  const auto comparison = reference::compare(work.chain, work.exact, found);
  state.counters["pairs"] = static_cast<double>(found.pair_count);
  if (comparison.right()) return "";
  state.counters["missing"] = static_cast<double>(comparison.missing);
  state.counters["invented"] = static_cast<double>(comparison.invented);
  if (c.variant.arithmetic != Robust::name && comparison.well_formed()) return "";
  return fmt::format("wrong answer: {} pairs missing, {} invented", comparison.missing, comparison.invented);
}

void measure(benchmark::State& state, const Case& c) {
  const auto work = workload(c.scene, c.n);
  Collisions found;
  std::unique_ptr<Variant> variant;
  try {
    variant = StrategyRegistry::instance().make(c.variant.name);
    variant->build(work->chain);
    variant->find(work->chain, {}, found);
  } catch (const CapacityError& refused) {
    state.SkipWithError(refused.what());
    return;
  }
  if (const auto why = wrong(c, *work, found, state); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  const auto mover =
      c.flush_cache && c.variant.on_device ? StrategyRegistry::instance().make_mover() : nullptr;
  for (auto iteration : state) {
    (void)iteration;
    if (mover) mover->flush_cache();
    const Stopwatch wall;
    if (c.stage != Stage::find) variant->update(work->chain);
    if (c.stage != Stage::build) variant->find(work->chain, {}, found);
    const Timings t = variant->timings();
    const double ms = c.stage == Stage::whole ? wall.ms() : c.stage == Stage::build ? t.build_ms : t.find_ms;
    state.SetIterationTime(ms / 1000);
  }
  state.counters["transfer_ms"] = variant->timings().transfer_ms;
  state.SetComplexityN(c.n);
}

bool worth_measuring(const VariantInfo& variant, std::uint32_t n, Stage stage) {
  if (variant.unavailable) return false;
  if (!variant.all_pairs) return true;
  return stage != Stage::build && n <= (variant.on_device ? most_all_pairs_device : most_all_pairs_host);
}

}  // namespace

void register_benchmarks(bool flush_cache) {
  const auto variants = StrategyRegistry::instance().variants();
  for (const char* scene : scenes)
    for (const std::uint32_t n : sizes)
      for (const auto& variant : variants)
        for (const auto& [stage, name] :
             {std::pair{Stage::build, "build"}, {Stage::find, "find"}, {Stage::whole, "whole"}}) {
          if (!worth_measuring(variant, n, stage)) continue;
          const Case c{scene, n, variant, stage, flush_cache};
          benchmark::RegisterBenchmark(fmt::format("{}/n:{}/{}/{}", scene, n, variant.name, name).c_str(),
                                       measure, c)
              ->UseManualTime()
              ->Unit(benchmark::kMillisecond);
        }
}

}  // namespace catena::bench

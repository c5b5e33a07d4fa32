#include "catena/bench/timing/calibration.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

#include "catena/core/executor/startable_threads.h"
#include "catena/core/strategy/timings.h"

namespace catena::bench {
namespace {

constexpr std::size_t points = 384;
constexpr std::uint32_t links = 1u << 15;  // of four bytes
constexpr std::uint32_t steps = 20'000;

/// The kernel's data, the same in every run.
struct Kernel {
  std::array<float, points> x, y, z;
  std::vector<std::uint32_t> next;  // one cycle through all

  Kernel() : next(links) {
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random()) * 0x1p-32f; };
    for (std::size_t i = 0; i < points; ++i) x[i] = number(), y[i] = number(), z[i] = number();
    std::vector<std::uint32_t> order(links);
    std::iota(order.begin(), order.end(), 0u);
    for (std::uint32_t i = links - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
    for (std::uint32_t i = 0; i < links; ++i) next[order[i]] = order[(i + 1) % links];
  }

  std::uint32_t run() const {
    std::uint32_t near = 0, at = 0;
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const float dx = x[i] - x[j], dy = y[i] - y[j], dz = z[i] - z[j];
        near += dx * dx + dy * dy + dz * dz < 0.01f;
      }
    for (std::uint32_t step = 0; step < steps; ++step) at = next[at];
    return near + at;
  }
};

/// Keeps the work: a result that nobody reads would not be computed.
std::atomic<std::uint32_t> kept;

void run_once(const Kernel& kernel) { kept.store(kernel.run(), std::memory_order_relaxed); }

}  // namespace

Load measured_load() {
  static const Kernel kernel;
  static const unsigned cores = 1 + startable_threads(std::max(1u, std::thread::hardware_concurrency()) - 1);
  Load load;
  run_once(kernel);  // into the caches, from which the sample before has driven it
  const Stopwatch one;
  run_once(kernel);
  load.one_ms = one.ms();
  const Stopwatch all;
  {
    std::vector<std::jthread> threads;
    for (unsigned t = 1; t < cores; ++t) threads.emplace_back([] { run_once(kernel); });
    run_once(kernel);
  }
  load.all_ms = all.ms();
  return load;
}

}  // namespace catena::bench

// Linked with -ffast-math, though not compiled with it, so that its start turns subnormal numbers to zero.
// The library answers as in any other program.
#include <catena/core/strategy/registry.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace {

/// main.cpp's zigzag in multiples of the least number: a subnormal's bits are that multiple. Nothing here
/// computes.
catena::Chain zigzag() {
  const auto times_least = [](std::uint32_t k) { return std::bit_cast<float>(k); };
  std::vector<catena::Sphere> spheres;
  for (std::uint32_t i = 0; i < 100; ++i)
    spheres.push_back({times_least(i % 10 * 6), times_least(i / 10 * 3), 0, times_least(2)});
  return catena::Chain(std::move(spheres), catena::Strands::one_closed(100));
}

}  // namespace

int main() {
  volatile float least_normal = std::numeric_limits<float>::min();
  if (0.5f * least_normal > 0) {
    std::puts("nothing is flushed here, so this shows nothing");
    return 2;
  }
  for (const std::string name :
       {"CPU1", "GPU1@host", "aCPU2+CPU2", "aCPU2+Dual", "bGPU2@host+GPU2@host", "aGPU2@host+GPUv2@host"}) {
    const auto variant = catena::StrategyRegistry::instance().make(name);
    const catena::Chain chain = zigzag();
    catena::Collisions found;
    variant->build(chain);
    variant->find(chain, {}, found);
    std::printf("%s: %llu pairs\n", name.c_str(), static_cast<unsigned long long>(found.pair_count));
    if (found.pair_count != 90) return 1;
  }
  return 0;
}

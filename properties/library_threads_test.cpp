#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"

/// The variants of libcatena that take threads, on chains long enough for many ranges of work. By the library
/// alone, so that CI can afford it under ThreadSanitizer.
namespace catena {
namespace {

/// A walk that stays in a ball, so that much of it is crowded, or goes off with `drift`; radii of `octaves`
/// sizes.
Chain walk(std::uint32_t n, float drift, int octaves, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  std::vector<Sphere> spheres;
  float at[3] = {0, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    for (float& x : at) x = 0.99f * x + 2 * unit() - 1;
    spheres.push_back(
        {at[0] + drift * static_cast<float>(i), at[1], at[2],
         0.1f * std::ldexp(1.0f, -static_cast<int>(random() % static_cast<std::uint32_t>(octaves)))});
  }
  return Chain(std::move(spheres));
}

Collisions found_by(const std::string& name, const Chain& chain) {
  const auto variant = StrategyRegistry::instance().make(name);
  Collisions found;
  for (int again = 0; again < 2; ++again) {  // buffers are used again
    variant->build(chain);
    variant->find(chain, {}, found);
  }
  std::ranges::sort(found.pairs, {}, [](const Pair& pair) { return std::pair(pair.i, pair.j); });
  return found;
}

TEST(LibraryThreads, GiveTheAnswerOfOne) {
  for (const Chain& chain : {walk(20'000, 0, 1, 1), walk(20'000, 0.05f, 1, 2), walk(10'000, 0.01f, 4, 3)}) {
    const Collisions expected = found_by("aCPU2+Dual", chain);
    ASSERT_GT(expected.pairs.size(), 10u);
    for (const char* const name :
         {"Hybrid(threads=3)", "Hybrid(threads=3,crowd=2)", "Hybrid(threads=3,crowd=100000)",
          "Hybrid(threads=3,crowd=0,dense=1e6)", "Hybrid(threads=3,crowd=0,dense=0)", "Grid(threads=3,cells=wide)", "Grid(threads=3,cells=narrow)",
          "SphereTree(threads=3)", "aGPU2@host(threads=3)+GPU2@host(threads=3)",
          "Parts(parts=3,searches=2,order=chain)", "Parts(parts=3,searches=4,order=chain)",
          "Parts(parts=3,searches=3,order=space)"}) {
      const Collisions found = found_by(name, chain);
      EXPECT_EQ(found.pairs, expected.pairs) << name;
      EXPECT_EQ(found.count, expected.count) << name;
    }
  }
}

}  // namespace
}  // namespace catena

#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

// Chains of straight blocks of 32 spheres, and all searches by blocks and hashed cells on them.
namespace catena::properties {

inline constexpr std::uint32_t block = CapsuleBlocks::block;

/// A straight block of spheres of radius 1, about 50 long, centred at a point, along x or y.
inline void add_rod(std::vector<Sphere>& spheres, float x, float y, float z, bool along_y = false,
                    float size = 1) {
  for (std::uint32_t k = 0; k < block; ++k) {
    const float s = 1.6f * size * (static_cast<float>(k) - 15.5f);
    spheres.push_back({along_y ? x : x + s, along_y ? y + s : y, z, size});
  }
}

inline Chain each_block_a_strand(const std::vector<Sphere>& spheres) {
  Strands strands;
  for (std::uint32_t at = 0; at <= spheres.size(); at += block) strands.first.push_back(at);
  return Chain(spheres, strands);
}

/// As many rods, scattered in a cube: what is next in the chain is not near, and all nodes meet one another.
inline std::vector<Sphere> scattered_rods(std::uint32_t rods, float side) {
  std::vector<Sphere> spheres;
  std::uint32_t state = 12345;
  const auto at = [&] {
    return side * static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
  };
  for (std::uint32_t k = 0; k < rods; ++k) {
    const float x = at(), y = at(), z = at();
    add_rod(spheres, x, y, z, k % 2 == 0);
  }
  return spheres;
}

/// By all searches of this kind that can run here.
inline void expect_exact(const Chain& chain, const std::string& what, bool with_pairs = true) {
  const auto exact = reference::find(chain);
  ASSERT_EQ(exact.pair_count > 0, with_pairs) << what;
  for (const VariantInfo& info : StrategyRegistry::instance().variants()) {
    if (info.unavailable || !info.name.starts_with("Device")) continue;
    std::vector<std::string> names{info.name};
    if (info.name.starts_with("DeviceHybrid"))
      for (const char* p :
           {"(least=0)", "(least=0,cells=0)", "(least=0,crowd=0)", "(least=0,cells=0,crowd=0)",
            "(least=0,crowd=2)", "(least=0,cells=0,crowd=2)", "(least=0,cells=4194304)", "(least=0,survey=0)",
            "(least=0,cells=0,survey=0)", "(least=0,cells=0,crowd=2,survey=0)"})
        names.push_back(info.name + p);
    if (info.name.starts_with("DeviceCapsules"))
      for (const char* p : {"(crowd=0)", "(crowd=2)"}) names.push_back(info.name + p);
    for (const std::string& name : names) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      EXPECT_TRUE(reference::compare(chain, exact, found).right()) << name << ": " << what;
    }
  }
}

}  // namespace catena::properties

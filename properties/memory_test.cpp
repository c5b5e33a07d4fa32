#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/allocations.h"
#include "catena/properties/generators/dice.h"

// What a search keeps beside the chain, whatever the length of strands, which decides how full blocks are.
namespace catena::properties {
namespace {

/// Straight strands of so many spheres, at random in a cube, about one pair a sphere, or few.
Chain strands_of(std::uint32_t length, std::uint32_t n, float side) {
  Dice dice(length);
  std::vector<Sphere> spheres;
  Strands strands;
  while (spheres.size() < n) {
    strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
    const float at[3] = {side * dice.symmetric(), side * dice.symmetric(), side * dice.symmetric()},
                way[3] = {dice.symmetric(), dice.symmetric(), dice.symmetric()};
    for (std::uint32_t k = 0; k < length && spheres.size() < n; ++k) {
      const auto step = static_cast<float>(k);
      spheres.push_back({at[0] + step * way[0], at[1] + step * way[1], at[2] + step * way[2], 1});
    }
  }
  strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
  return Chain(std::move(spheres), std::move(strands));
}

/// Bytes that a variant holds after a frame, but for what a chain of no spheres takes.
double held_a_sphere(const std::string& name, const Chain& chain) {
  const Allocations::Read held = Allocations::held();
  const auto variant = StrategyRegistry::instance().make(name);
  Collisions found;
  const Chain empty;
  variant->build(empty);
  variant->find(empty, {}, found);
  Collisions pairs;
  variant->find(empty, {}, pairs);
  const std::uint64_t before = held();
  variant->build(chain);
  const std::uint64_t built = held();
  variant->find(chain, {Request::Want::counts}, pairs);
  const double counts = static_cast<double>(pairs.count.capacity()) * sizeof(std::uint32_t);
  return (static_cast<double>(std::max(built, held())) - static_cast<double>(before) - counts) / chain.size();
}

TEST(Memory, OfASphereIsBoundedForStrandsOfAnyLength) {
  ASSERT_NE(Allocations::held(), nullptr);
  constexpr std::uint32_t n = 40'000;
  for (const float side : {40.0f, 100.0f})
    for (std::uint32_t length = 1; length <= 40; ++length) {
      const Chain chain = strands_of(length, n, side);
      EXPECT_LE(held_a_sphere("SphereTree", chain), 40) << length << " spheres a strand, side " << side;
      // 40 is the aim; strands of nine, whose blocks are half empty, and of which some are dense, take most.
      EXPECT_LE(held_a_sphere("Hybrid", chain), 56) << length << " spheres a strand, side " << side;
    }
}

}  // namespace
}  // namespace catena::properties

#include "catena/core/ranks/border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

/// A random walk in a box, in single blocks.
Part walk(unsigned rank, std::uint32_t blocks) {
  std::mt19937 dice(rank);
  std::uniform_real_distribution<float> step(-1, 1), at(0, 20);
  Part part;
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const SphereId first = (SphereId{rank} << 32) + 9 * b;
    part.pieces.push_back({first, b * Block::most, Block::most, {first, Block::most, 0, 0, first}});
    Sphere s{at(dice), at(dice), at(dice), .5f};
    for (std::uint32_t k = 0; k < Block::most; ++k) {
      part.spheres.push_back(s);
      s = {s.x + step(dice), s.y + step(dice), s.z + step(dice), s.radius};
    }
  }
  return part;
}

/// Whatever the number of ranks and of blocks: of two, the higher one tells about half of what is near the
/// lower one, and compares the others itself.
TEST(Border, IsComparedByBothOfTwoRanksAboutEvenly) {
  for (const unsigned size : {2u, 5u})
    for (const std::uint32_t blocks : {100u, 1000u, 4500u})
      run_in_threads(size, [&](Communicator& ranks) {
        const HeldPart part(walk(ranks.rank(), blocks));
        const Border border(ranks, part);
        for (unsigned other = 0; other < size; ++other) {
          if (other == ranks.rank()) continue;
          ASSERT_TRUE(border.near(other));
          if (other > ranks.rank()) {
            EXPECT_EQ(border.compared(other), 0u);
            EXPECT_NEAR(static_cast<double>(border.expected(other)),
                        static_cast<double>(border.told(other).size()) / 2, 1);
            continue;
          }
          const auto told = static_cast<double>(border.told(other).size());
          EXPECT_NEAR(told / static_cast<double>(border.expected(other)), .5, .13) << blocks;
          for (const std::uint32_t b : border.told(other)) EXPECT_EQ(b & border.compared(other), 0u);
        }
      });
}

/// Blocks that follow one another in a border are near in space: stripes of it are, and so what a rank tells.
TEST(Border, IsInTheOrderOfSpace) {
  run_in_threads(2, [&](Communicator& ranks) {
    const HeldPart part(walk(ranks.rank(), 1000));
    const Border border(ranks, part);
    const std::span<const Block> blocks = border.blocks();
    ASSERT_GT(blocks.size(), 100u);
    const auto apart = [&](std::size_t a, std::size_t b) {
      const Sphere &p = part.spheres(blocks[a])[0], &q = part.spheres(blocks[b])[0];
      return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
    };
    float successive = 0, half_a_border = 0;
    for (std::size_t k = 0; k + 1 < blocks.size(); ++k) {
      successive += apart(k, k + 1);
      half_a_border += apart(k, (k + blocks.size() / 2) % blocks.size());
    }
    EXPECT_LT(successive, half_a_border / 2);
  });
}

}  // namespace
}  // namespace catena::ranks

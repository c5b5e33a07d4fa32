#include "catena/core/ranks/tops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

Box cube(float x, float y, float z, float half) {
  return {{x - half, y - half, z - half}, {x + half, y + half, z + half}};
}

bool encloses(const Box& outer, const Box& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis]) return false;
  return true;
}

/// No block of any rank is outside of its tops: ones at every corner of all, too.
TEST(Tops, EncloseEveryBlock) {
  for (const unsigned blocks : {1u, 2u, 9u, 500u})
    run_in_threads(3, [&](Communicator& c) {
      std::mt19937 dice(c.rank() + blocks);
      std::uniform_real_distribution<float> at(-50, 50);
      std::vector<Box> own;
      for (unsigned b = 0; b < blocks; ++b) own.push_back(cube(at(dice), at(dice), at(dice), 1));
      for (unsigned corner = 0; blocks > 1 && corner < 8; ++corner)
        own.push_back(cube(corner & 1 ? 60 : -60, corner & 2 ? 60 : -60, corner & 4 ? 60 : -60, 1));
      const Tops tops = Tops::of_all(c, own);
      const unsigned rank = c.rank();
      EXPECT_LE(tops.boxes_of(rank), Tops::most_of(3));
      for (const Box& block : own) {
        EXPECT_TRUE(encloses(tops.around(rank), block));
        bool enclosed = false;
        for (std::uint32_t k = 0; k < tops.boxes_of(rank); ++k)
          enclosed |= encloses(tops.box(rank, k), block);
        EXPECT_TRUE(enclosed) << block.low[0] << ' ' << block.low[1] << ' ' << block.low[2];
      }
      for (std::uint32_t k = 0; k < tops.boxes_of(rank); ++k)
        EXPECT_TRUE(
            std::ranges::any_of(own, [&](const Box& block) { return encloses(tops.box(rank, k), block); }));
    });
}

/// What lies in the crook of an angle is near none of its blocks, though the box around all is around it.
TEST(Tops, KnowWhatIsNearNoneOfTheBlocks) {
  run_in_threads(2, [](Communicator& c) {
    std::vector<Box> own;
    for (float k = 0; k < 100; k += 2)
      if (c.rank() == 0)
        own.push_back(cube(k, 0, 0, 1)), own.push_back(cube(0, k, 0, 1));
      else
        own.push_back(cube(60 + k / 4, 60 + k / 4, 0, 1));
    const Tops tops = Tops::of_all(c, own);
    EXPECT_TRUE(tops.around(0).meets(tops.around(1)));
    const ForeignTops foreign(tops, c.rank());
    for (const Box& block : own) EXPECT_FALSE(foreign.meet(block));
    if (c.rank() == 1) {
      EXPECT_FALSE(foreign.any());
    }
  });
}

TEST(Tops, OfTwoBlocksAreApart) {
  run_in_threads(2, [](Communicator& c) {
    const std::vector<Box> own =
        c.rank() == 0 ? std::vector{cube(-50, 0, 0, 1), cube(50, 0, 0, 1)} : std::vector{cube(0, 0, 0, 1)};
    const ForeignTops foreign(Tops::of_all(c, own), c.rank());
    for (const Box& block : own) EXPECT_FALSE(foreign.meet(block));
  });
}

}  // namespace
}  // namespace catena::ranks

#include "catena/core/ranks/block.h"

#include <gtest/gtest.h>

#include <random>

#include "catena/core/hierarchy/box_around.h"
#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/properties/testing/random_spheres.h"

namespace catena::ranks {
namespace {

using properties::random_spheres;

TEST(Block, EveryOneIsVisitedAndSomeEvenly) {
  const Strand strand{0, 1000, 0, 0, 0};
  const std::vector<Piece> pieces{
      {0, 0, 17, strand}, {20, 17, 1, strand}, {30, 18, 64, strand}, {99, 82, 9, strand}};
  std::vector<std::uint32_t> begins, seen;
  for_each_block(pieces, [&](const Block& b) {
    begins.push_back(b.begin);
    for (std::uint32_t k = 0; k < b.size; ++k) seen.push_back(b.begin + k);
    EXPECT_LE(b.begin + b.size, pieces[b.piece].begin + pieces[b.piece].size);
  });
  EXPECT_EQ(begins.size(), blocks_of(pieces));
  ASSERT_EQ(seen.size(), 91u);
  for (std::uint32_t k = 0; k < 91; ++k) EXPECT_EQ(seen[k], k);
  for (const std::uint64_t step : {1u, 2u, 3u, 5u, 13u, 40u}) {
    std::vector<std::uint32_t> some, expected;
    for_some_blocks(pieces, step, [&](const Block& b) { some.push_back(b.begin); });
    for (std::size_t k = step / 2; k < begins.size(); k += step) expected.push_back(begins[k]);
    EXPECT_EQ(some, expected) << step;
  }
}

/// Whatever pieces there are: eight blocks at most, and where a piece ends none of the next, unless there
/// were too few spheres.
TEST(Block, AStretchIsAroundItsBlocks) {
  std::mt19937 dice(3);
  const Strand strand{0, 1000, 0, 0, 0};
  std::size_t full = 0, ended = 0, went_on = 0;
  for (const std::uint32_t longest : {1u, 8u, 30u, 300u})
    for (const std::uint32_t count : {0u, 1u, 7u, 8u, 9u, 40u}) {
      std::vector<Piece> pieces;
      std::uint32_t spheres = 0;
      for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t size = 1 + dice() % longest;
        pieces.push_back({2 * spheres, spheres, size, strand}), spheres += size;
      }
      const std::vector<Sphere> all = random_spheres(spheres, dice, 1);
      std::vector<std::vector<Block>> stretches;
      for_each_block(pieces, [&](const Block& block) {
        std::uint32_t so_far = 0;
        if (!stretches.empty())
          for (const Block& before : stretches.back()) so_far += before.size;
        const bool next_piece = stretches.empty() || stretches.back().back().piece != block.piece;
        const bool begins =
            stretches.empty() || stretches.back().size() == 8 || (next_piece && so_far >= Block::most);
        if (!stretches.empty()) {
          full += begins && stretches.back().size() == 8;
          ended += begins && stretches.back().size() < 8;
          went_on += !begins && next_piece;
        }
        if (begins) stretches.emplace_back();
        stretches.back().push_back(block);
      });
      const LargeVector<Box> boxes = boxes_of_stretches(pieces, all);
      ASSERT_EQ(boxes.size(), stretches.size());
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        const Block &first = stretches[k].front(), &last = stretches[k].back();
        const Box exact =
            box_around(std::span(all).subspan(first.begin, last.begin + last.size - first.begin));
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(boxes[k].low[axis], exact.low[axis]) << count << ' ' << k;
          EXPECT_EQ(boxes[k].high[axis], exact.high[axis]) << count << ' ' << k;
        }
      }
    }
  EXPECT_TRUE(full > 50 && ended > 50 && went_on > 50) << full << ' ' << ended << ' ' << went_on;
}

TEST(WideBoxTree, SaysWhetherAnyBoxMeets) {
  std::mt19937 dice(5);
  for (const std::uint32_t boxes : {0u, 16u, 17u, 300u}) {
    WideBoxTree tree;
    tree.clear(boxes);
    for (std::uint32_t k = 0; k < boxes; ++k) tree.set(k, Box::around(random_spheres(1, dice, 1)[0]));
    tree.refresh(0, boxes);
    std::uint32_t met = 0;
    for (int round = 0; round < 200; ++round) {
      const Box box = Box::around(random_spheres(1, dice, 1)[0]);
      bool any = false;
      tree.for_each_meeting(box, [&](std::uint32_t) { any = true; });
      EXPECT_EQ(tree.meets(box), any);
      met += any;
    }
    EXPECT_EQ(met > 0, boxes >= 16);
  }
}

}  // namespace
}  // namespace catena::ranks

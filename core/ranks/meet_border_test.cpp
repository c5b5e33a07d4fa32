#include "catena/core/ranks/meet_border.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/hierarchy/box_around.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/properties/forced_target.h"
#include "hwy/highway.h"

namespace catena::ranks {
namespace {

/// Pieces of one to thirty spheres, so that most blocks are not full, of very unlike radii, some of them such
/// as no square is a number.
Part pieces_anywhere(std::mt19937& dice, std::uint32_t pieces, SphereId first) {
  std::uniform_real_distribution<float> at(0, 10), radius(-6, 0);
  Part part;
  for (std::uint32_t p = 0; p < pieces; ++p) {
    const std::uint32_t size = 1 + dice() % 30;
    part.pieces.push_back(
        {first, static_cast<std::uint32_t>(part.spheres.size()), size, {first, size, 0, 0, first}});
    const float scale = p % 11 == 10 ? 0x1p100f : 1;
    for (std::uint32_t k = 0; k < size; ++k)
      part.spheres.push_back(
          {at(dice) * scale, at(dice) * scale, at(dice) * scale, std::exp2(radius(dice)) * scale});
    first += size + 1;
  }
  return part;
}

/// Every pair of a block that came and of one of the border: none that overlaps is missed, and what is left
/// out is of those that the other rank compares.
void expect_all_met(const HeldPart& part, const Border& border, const FarBlocks& far, std::uint64_t most) {
  LargeVector<Meeting> meetings;
  std::uint64_t met = 0;
  for (std::uint32_t next = 0; next < far.blocks();) {
    const std::uint32_t before = next;
    met += meet_border(border, far, most, next, meetings);
    ASSERT_GT(next, before);
  }
  std::set<std::tuple<std::uint32_t, std::uint32_t, int>> may;
  for (const Meeting& m : meetings) {
    EXPECT_EQ(m.own_block & far.mark(m.far_block), far.mark(m.far_block));
    EXPECT_EQ(m.touch & m.may_touch, 0u);
    EXPECT_NE(m.touch | m.may_touch, 0u);
    for (int bit = 0; bit < 64; ++bit)
      if ((m.touch | m.may_touch) >> bit & 1) {
        ASSERT_LT(bit / 8u, border.blocks()[m.own_block].size);
        ASSERT_LT(bit % 8u, far.spheres(m.far_block).size());
        EXPECT_TRUE(may.insert({m.far_block, m.own_block, bit}).second);
        if (m.touch >> bit & 1) {
          EXPECT_TRUE(
              Robust::overlap(border.spheres(m.own_block)[bit / 8u], far.spheres(m.far_block)[bit % 8u]));
        }
      }
  }
  std::size_t overlaps = 0, all = 0;
  std::uint64_t boxes = 0;
  for (std::uint32_t f = 0; f < far.blocks(); ++f)
    for (std::uint32_t b = 0; b < border.blocks().size(); ++b) {
      const auto own = part.spheres(border.blocks()[b]), theirs = far.spheres(f);
      const Box box = box_around(theirs);
      boxes += is_compared(b, far.mark(f)) && border.boxes().box(b).meets(box);
      all += own.size() * theirs.size();
      bool touches = false;
      for (std::size_t k = 0; k < own.size(); ++k)
        for (std::size_t j = 0; j < theirs.size(); ++j)
          if (Robust::overlap(own[k], theirs[j])) {
            touches = true;
            if ((b & far.mark(f)) != far.mark(f)) continue;
            ++overlaps;
            EXPECT_TRUE(may.contains({f, b, static_cast<int>(8 * k + j)})) << f << ' ' << b;
          }
      const std::uint32_t compared = std::bit_floor(b);
      ToldBlock told[] = {ToldBlock::along(7, theirs)};
      told[0].hold(theirs);
      std::vector<std::uint32_t> touching;
      may_touch_border(border, told, compared, touching);
      const Box told_box = told[0].box();
      EXPECT_EQ(!touching.empty(), [&] {
        for (std::uint32_t c = 0; c < border.blocks().size(); ++c)
          if ((c & compared) == compared)
            for (const Sphere& s : part.spheres(border.blocks()[c]))
              if (border.boxes().box(c).meets(told_box) && MeetsBox(told_box)(s) && told[0].may_touch(s))
                return true;
        return false;
      }());
      if (touches) {
        EXPECT_EQ(touching, std::vector{7u});
      }
    }
  EXPECT_GT(overlaps, 0u);
  EXPECT_LT(may.size(), all / 20);  // those whose squares are no numbers among them
  EXPECT_EQ(met, boxes);
}

/// What a rank is told of blocks holds their spheres, as binary64 has it, and not much more.
void expect_told_as_they_are(const Border& border) {
  std::vector<std::uint32_t> all(border.blocks().size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<ToldBlock> told;
  tell_of_border(border, all, told);
  ASSERT_EQ(told.size(), all.size());
  for (const std::uint32_t b : all) {
    ToldBlock expected = ToldBlock::along(b, border.spheres(b));
    expected.hold(border.spheres(b));
    EXPECT_EQ(told[b].block, b);
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(told[b].first[d], expected.first[d]);
      EXPECT_EQ(told[b].last[d], expected.last[d]);
    }
    EXPECT_GE(told[b].radius, expected.radius * (1 - 0x1p-23f)) << b;
    EXPECT_LE(told[b].radius, expected.radius * 1.01f) << b;
  }
}

/// Pairs of strands of up to eight spheres, of which those of one rank touch those of the other, or nearly
/// so: both tell of blocks, and ask for them, as if each were compared with each in exact arithmetic.
TEST(MeetBorder, AsksForEveryBlockThatTouchesAtAnyScale) {
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    for (const int exponent : {-120, -60, -45, -30, -18, 0, 13, 40, 62, 100}) {
      std::size_t touching = 0;
      run_in_threads(2, [&](Communicator& ranks) {
        std::mt19937 dice(11);  // the same for both, who keep a half each
        std::normal_distribution<float> normal;
        const float scale = std::exp2(static_cast<float>(exponent));
        Part part;
        for (std::uint32_t k = 0; k < 200; ++k) {
          const float way[] = {normal(dice), normal(dice), normal(dice)},
                      from[] = {60 * normal(dice), 60 * normal(dice), 60 * normal(dice)};
          std::vector<Sphere> spheres;
          const std::uint32_t size = 1 + dice() % 8;
          const float step = k % 3 == 0 ? 1e4f : 1;  // some so long that rounding is much of a radius
          for (std::uint32_t j = 0; j < size; ++j) {
            const auto at = [&](int d) { return from[d] + static_cast<float>(j) * step * way[d]; };
            spheres.push_back({at(0), at(1), at(2), 0.5f});
          }
          const Sphere near = spheres[dice() % size];
          const float x = normal(dice), y = normal(dice), z = normal(dice),
                      apart = (1 + 1e-6f * normal(dice)) / std::sqrt(x * x + y * y + z * z);
          if (ranks.rank() == 1)
            spheres = {{near.x + apart * x, near.y + apart * y, near.z + apart * z, 0.5f}};
          const auto count = static_cast<std::uint32_t>(spheres.size());
          const SphereId first = (SphereId{ranks.rank()} << 32) + 16 * k;
          part.pieces.push_back(
              {first, static_cast<std::uint32_t>(part.spheres.size()), count, {first, count, 0, 0, first}});
          for (const Sphere& s : spheres)
            part.spheres.push_back({s.x * scale, s.y * scale, s.z * scale, s.radius * scale});
        }
        const HeldPart held(std::move(part));
        const Border border(ranks, held);
        std::vector<std::uint32_t> all(border.blocks().size()), asked;
        std::iota(all.begin(), all.end(), 0u);
        std::vector<ToldBlock> told;
        tell_of_border(border, all, told);
        ByteWriter out, spheres;
        put_blocks(spheres, held, border.blocks());
        const auto messages = ranks.exchange({{1 - ranks.rank(), out.put_list(told).take()}});
        const auto theirs = ranks.exchange({{1 - ranks.rank(), spheres.take()}});
        ByteReader in(messages[0].bytes), blocks(theirs[0].bytes);
        const auto told_by_other = in.get_list<ToldBlock>();
        may_touch_border(border, told_by_other, 0, asked);
        FarBlocks far;
        far.take(blocks, held.rule(), 0);
        for (std::uint32_t f = 0; f < far.blocks(); ++f) {
          bool touches = false;
          for (const std::uint32_t b : all)
            for (const Sphere& own : border.spheres(b))
              for (const Sphere& other : far.spheres(f)) touches = touches || Robust::overlap(own, other);
          if (touches) {
            EXPECT_TRUE(std::ranges::binary_search(asked, f)) << f << " at 2^" << exponent;
          }
          touching += ranks.rank() == 0 && touches;
        }
        EXPECT_LT(asked.size(), told_by_other.size());
      });
      EXPECT_GT(touching, 50u);
    }
  }
}

TEST(MeetBorder, MissesNothingOnAnyInstructionSet) {
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    run_in_threads(2, [](Communicator& ranks) {
      std::mt19937 dice(7 + ranks.rank());
      const HeldPart part(pieces_anywhere(dice, 23, SphereId{ranks.rank()} << 32));
      const Border border(ranks, part);
      ASSERT_GT(border.blocks().size(), 20u);
      expect_told_as_they_are(border);
      ByteWriter out;
      put_blocks(out, part, border.blocks());
      for (const Message& message : ranks.exchange({{1 - ranks.rank(), out.take()}}))
        for (const std::uint32_t mark : {0u, 8u}) {
          FarBlocks far;
          ByteReader in(message.bytes);
          far.take(in, part.rule(), mark);
          for (const std::uint64_t most : {1u, 40u, 1u << 20}) expect_all_met(part, border, far, most);
        }
    });
  }
}

/// Single spheres in one place, of which those of one rank are more than are looked at at a time.
TEST(MeetBorder, MeetsEveryBlockOfACrowd) {
  static constexpr std::uint32_t crowd = 2100;
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    run_in_threads(2, [](Communicator& ranks) {
      Part part;
      const std::uint32_t pieces = ranks.rank() == 0 ? crowd : 2;
      for (std::uint32_t k = 0; k < pieces; ++k) {
        const SphereId first = (SphereId{ranks.rank()} << 32) + 2 * k;
        part.pieces.push_back({first, k, 1, {first, 1, 0, 0, first}});
        part.spheres.push_back({1, 2, 3, 1});
      }
      const HeldPart held(std::move(part));
      const Border border(ranks, held);
      ByteWriter out;
      put_blocks(out, held, border.blocks());
      const auto messages = ranks.exchange({{1 - ranks.rank(), out.take()}});
      if (ranks.rank() != 0) return;
      FarBlocks far;
      ByteReader in(messages[0].bytes);
      far.take(in, held.rule(), 0);
      ASSERT_EQ(border.blocks().size(), crowd);
      LargeVector<Meeting> meetings;
      std::uint32_t next = 0;
      EXPECT_EQ(meet_border(border, far, crowd, next, meetings), crowd);
      EXPECT_EQ(next, 1u) << "so many were enough";
      std::set<std::uint32_t> met;
      for (const Meeting& m : meetings) met.insert(m.own_block);
      EXPECT_EQ(meetings.size(), crowd);
      EXPECT_EQ(met.size(), crowd);
    });
  }
}

/// What is told of blocks whose spheres are great beside their distances, which rounding hides, or small
/// beside the length of their axis, which is rounded by much of a radius, or so far away from one another
/// that no square of it is a number.
TEST(MeetBorder, TellsARadiusThatHoldsTheSpheres) {
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    run_in_threads(2, [](Communicator& ranks) {
      std::mt19937 dice(13);
      std::uniform_real_distribution<float> unit(0.5f, 1);
      Part part;
      for (std::uint32_t k = 0; k < 400; ++k) {
        const SphereId first = (SphereId{ranks.rank()} << 32) + 4 * k;
        part.pieces.push_back({first, 3 * k, 3, {first, 3, 0, 0, first}});
        const float step = k % 4 != 0 ? std::exp2(-static_cast<float>(dice() % 24)) : 0x1p66f,
                    radius = k % 4 != 0 ? 1 : 0x1p60f;
        const float ends = k % 8 != 0 ? 0 : step;  // the third is beside the axis, or beyond it
        if (k % 4 == 1) {                          // the middle one about on the axis
          const float x = unit(dice), y = unit(dice), z = unit(dice), small = 0x1p-22f * unit(dice);
          part.spheres.push_back({0, 0, 0, small});
          part.spheres.push_back({0.7f * x, 0.7f * y, 0.7f * z, small});
          part.spheres.push_back({x, y, z, small});
          continue;
        }
        part.spheres.push_back({0, 0, 0, radius * unit(dice)});
        part.spheres.push_back({step * unit(dice), step * unit(dice), -step * unit(dice), radius});
        part.spheres.push_back({ends, ends, 0, radius * unit(dice)});
      }
      const HeldPart held(std::move(part));
      const Border border(ranks, held);
      std::vector<std::uint32_t> all(border.blocks().size());
      std::iota(all.begin(), all.end(), 0u);
      std::vector<ToldBlock> told;
      tell_of_border(border, all, told);
      ASSERT_EQ(told.size(), 400u);
      for (const ToldBlock& block : told)
        for (const Sphere& s : border.spheres(block.block)) {
          const auto square = [](long double x) { return x * x; };
          const long double ax = block.last[0], ay = block.last[1], az = block.last[2],
                            length = square(ax) + square(ay) + square(az),
                            part_of_it =
                                length > 0 ? std::clamp((ax * s.x + ay * s.y + az * s.z) / length, 0.0L, 1.0L)
                                           : 0;
          ASSERT_GE(block.radius, std::sqrt(square(s.x - part_of_it * ax) + square(s.y - part_of_it * ay) +
                                            square(s.z - part_of_it * az)) +
                                      s.radius)
              << block.block;
        }
    });
  }
}

/// What came without the arc lengths that the rule goes by, or with some that nobody asked for, is no blocks.
TEST(MeetBorder, TakesNoBlocksOfAnotherRule) {
  run_in_threads(1, [](Communicator&) {
    std::mt19937 dice(3);
    const HeldPart part(pieces_anywhere(dice, 5, 0));
    std::vector<Block> blocks;
    for_each_block(part.pieces(), [&](const Block& block) { blocks.push_back(block); });
    ASSERT_FALSE(blocks.empty());
    ByteWriter out;
    put_blocks(out, part, blocks);
    const Bytes bytes = out.take();
    Rule others = part.rule();
    const bool by_arcs = others.kind == Exclusion::Rule::arc_window;
    others.kind = by_arcs ? Exclusion::Rule::index_window : Exclusion::Rule::arc_window;
    FarBlocks far, as_meant;
    ByteReader in(bytes), again(bytes);
    EXPECT_THROW(far.take(in, others, 0), std::logic_error);
    as_meant.take(again, part.rule(), 0);
    EXPECT_EQ(as_meant.blocks(), blocks.size());
  });
}

}  // namespace
}  // namespace catena::ranks

#include "catena/core/parts/local_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/parts/part_as_chain.h"
#include "catena/properties/generators/family.h"

namespace catena::parts {
namespace {

using properties::Dice;

/// Some of the chain, in runs of any length: its own, those before and after it, and what is not in it.
PartRanges any_part(std::uint32_t n, Dice& dice) {
  if (dice.one_in(4) && n > 2)  // all but an end, around which neighbours are
    return {{}, {dice.one_in(2) ? SphereRange{1, n} : SphereRange{0, n - 1}}, {}};
  std::array<std::vector<SphereRange>, 3> ranges;
  for (std::uint32_t at = 0; at < n;) {
    const std::uint32_t end = std::min(n, at + 1 + dice.below(dice.one_in(3) ? n : 3));
    if (const std::uint32_t whose = dice.below(4); whose < 3) ranges[whose].push_back({at, end});
    at = end;
  }
  return {std::move(ranges[0]), std::move(ranges[1]), std::move(ranges[2])};
}

/// As a device reads them: first the lesser, each once and sorted, and within a closed piece none but the
/// chain's own further pairs. None of two that are apart, which nobody asks for: those may be many.
void expect_in_order(const LocalChain& part, const Chain& whole) {
  EXPECT_EQ(std::ranges::adjacent_find(part.extra(), std::ranges::greater_equal{}), part.extra().end());
  const auto piece_of = [&](std::uint32_t i) {
    return std::ranges::upper_bound(part.pieces(), i, {}, &LocalChain::Piece::begin) - part.pieces().begin() -
           1;
  };
  for (const Pair& pair : part.extra()) {
    EXPECT_LT(pair.i, pair.j);
    EXPECT_TRUE(Robust::overlap(whole[part.id(pair.i)], whole[part.id(pair.j)]));
    const auto piece = piece_of(pair.i);
    if (piece != piece_of(pair.j) || !part.pieces()[static_cast<std::size_t>(piece)].closed) continue;
    const std::uint32_t i = part.id(pair.i), j = part.id(pair.j);
    EXPECT_TRUE(std::ranges::any_of(whole.exclusion().extra_pairs,
                                    [&](const Pair& p) {
                                      return p == Pair{i, j} || p == Pair{j, i};
                                    }))
        << i << ' ' << j;
  }
}

/// Whatever the rule, the strands and their closing, joints, and what of them a part has: also of a closed
/// strand that lacks a sphere, and of arcs whose middle is in another part.
TEST(LocalChain, HasTheNeighboursOfTheWhole) {
  std::uint64_t seed = 0, neighbours = 0, across = 0, arcs = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (int round = 0; round < 60; ++round) {
      Dice dice(++seed);
      const Chain whole = generate(family, dice, 20);
      const LocalChain part(whole, any_part(whole.size(), dice));
      if (part.size() == 0) continue;
      const Chain alone = part_as_chain(whole, part);
      ASSERT_EQ(alone.size(), part.size());
      expect_in_order(part, whole);
      for (std::uint32_t i = 0; i < part.size(); ++i) {
        ASSERT_EQ(alone[i], whole[part.id(i)]);
        for (std::uint32_t j = 0; j < part.size(); ++j) {
          if (i == j) continue;
          // Of two that are apart nobody asks.
          if (!Robust::overlap(alone[i], alone[j])) continue;
          const bool are = whole.neighbours(part.id(i), part.id(j));
          ASSERT_EQ(alone.neighbours(i, j), are)
              << family.name << ", seed " << seed << ": " << part.id(i) << " and " << part.id(j);
          neighbours += are;
        }
      }
      across += part.extra().size();
      arcs += part.extra().size() * (whole.exclusion().rule == Exclusion::Rule::arc_window);
    }
  EXPECT_GT(neighbours, 10'000u);
  EXPECT_GT(across, 1000u);
  EXPECT_GT(arcs, 100u);
}

}  // namespace
}  // namespace catena::parts

#include "catena/core/plan/coarse_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/chain/chain.h"
#include "catena/core/input/input.h"
#include "catena/core/plan/find.h"
#include "catena/reference/exact_gap.h"

namespace catena {
namespace {

constexpr std::uint32_t of_ring = 12 * CoarseLook::stretch;

/// A ring whose last sphere lies on its first, and whose second half is the first one, in the other way.
std::vector<Sphere> ring(float apart) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < of_ring; ++i)
    spheres.push_back(
        {static_cast<float>(std::min(i, of_ring - 1 - i)), i < of_ring / 2 ? 0 : apart, 0, 0.5f});
  return spheres;
}

/// Chains by whose rule some of what overlaps, or all of it, are neighbours.
std::vector<Chain> chains() {
  std::vector<Chain> all;
  for (const float apart : {0.f, 1.f, 1.5f}) {
    all.emplace_back(ring(apart));
    all.emplace_back(ring(apart), Strands::one_closed(of_ring));
    all.emplace_back(ring(apart), Strands::one_closed(of_ring), Exclusion::index(of_ring / 2));
    all.emplace_back(ring(apart), Strands{}, Exclusion::index(of_ring / 2));
    Exclusion across = Exclusion::index(1);
    for (std::uint32_t i = 0; i < of_ring / 2; ++i) across.extra_pairs.push_back({i, of_ring - 1 - i});
    all.emplace_back(ring(apart), Strands{}, across);
  }
  std::vector<Sphere> twos;  // each touches the next but one
  for (std::uint32_t i = 0; i < of_ring; ++i)
    twos.push_back({static_cast<float>(i / 2), i % 2 ? 2.f : 0, 0, 0.5f});
  all.emplace_back(std::move(twos));
  std::mt19937 dice(5);
  for (const float side : {20.f, 60.f}) {  // where many stretches are near one another
    std::uniform_real_distribution<float> at(0, side);
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < of_ring; ++i) spheres.push_back({at(dice), at(dice), at(dice), 0.3f});
    all.emplace_back(spheres);
    all.emplace_back(std::move(spheres), Strands{}, Exclusion::index(of_ring));
  }
  return all;
}

const std::vector<SphereRange> parts{
    {}, {0, 30}, {of_ring / 2 - 40, of_ring / 2 + 40}, {of_ring - 100, of_ring}, {7, 7}};

void expect_collides(const Chain& chain, const SphereRange& queries, const Pair& pair) {
  EXPECT_LT(pair.i, pair.j);
  EXPECT_LT(pair.j, chain.size());
  EXPECT_TRUE(queries.contains(pair.i));
  EXPECT_TRUE(reference::overlap(chain[pair.i], chain[pair.j]));
  EXPECT_FALSE(chain.neighbours(pair.i, pair.j)) << pair.i << ' ' << pair.j;
}

TEST(CoarseLook, GivesNoNeighboursAndIsTheSameWhateverItLookedAtBefore) {
  CoarseLook used;
  std::size_t found = 0;
  for (int round = 0; round < 2; ++round)
    for (const Chain& chain : chains())
      for (const SphereRange& queries : parts) {
        CoarseLook fresh;
        const auto pair = used.look(chain.view(), queries);
        EXPECT_EQ(pair, fresh.look(chain.view(), queries));
        EXPECT_EQ(used.compared(), fresh.compared());
        if (pair) ++found, expect_collides(chain, queries, *pair);
      }
  EXPECT_GT(found, 8u);
}

/// Stretches that follow one another touch wherever a chain does: to compare them would be most of the work.
TEST(CoarseLook, ComparesNoStretchWithTheNextOne) {
  std::vector<Sphere> straight, back;
  for (std::uint32_t i = 0; i < of_ring; ++i) {
    straight.push_back({static_cast<float>(i), 0, 0, 0.5f});
    back.push_back({static_cast<float>(std::min(i, of_ring - 1 - i)), i < of_ring / 2 ? 0 : 1.5f, 0, 0.5f});
  }
  CoarseLook look;
  EXPECT_FALSE(look.look(Chain(std::move(straight)).view(), {}));
  EXPECT_EQ(look.compared(), 0u);
  EXPECT_FALSE(look.look(Chain(std::move(back)).view(), {}));  // beside itself, at a distance
  EXPECT_GT(look.compared(), 0u);
}

/// Two rows beside each other, across the border of two cells of whichever axis.
TEST(CoarseLook, LooksIntoTheCellsAroundAlongEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Sphere> spheres;
    for (const Sphere& s : ring(0.9f)) {
      const float across = s.y - 0.5f, along = s.x + 1;
      const float places[] = {across, along, along};
      spheres.push_back({places[(3 - axis) % 3], places[(4 - axis) % 3], places[(5 - axis) % 3], s.radius});
    }
    // Neighbours near the end where the rows are one tube.
    const Chain chain(std::move(spheres), Strands{}, Exclusion::index(2 * CoarseLook::stretch));
    CoarseLook look;
    const auto pair = look.look(chain.view(), {});
    ASSERT_TRUE(pair) << axis;
    expect_collides(chain, {}, *pair);
  }
}

/// A look that finds nothing costs little, however near all stretches are to one another.
TEST(CoarseLook, ComparesNoMoreThanOnceAStretch) {
  constexpr std::uint32_t stretches = 60;
  const std::vector<Sphere> spheres(stretches * CoarseLook::stretch, {0, 0, 0, 1});
  const Chain chain(spheres, Strands{}, Exclusion::index(stretches * CoarseLook::stretch));
  CoarseLook look;
  EXPECT_FALSE(look.look(chain.view(), {}));
  EXPECT_LE(look.compared(), stretches);
}

/// As a frame asks about the contact of the last one: it is found again while it is there.
TEST(CoarseLook, FindsAContactAgainWhereverItIsAlongTheChain) {
  for (const Chain& chain : chains())
    for (const std::uint32_t i : {0u, 5u, 19u, 20u, 300u, of_ring / 2 - 41, of_ring / 2 - 2})
      for (const std::uint32_t j : {i + 2, i + 3, of_ring - 1 - i}) {
        if (j >= of_ring || j <= i) continue;
        for (const SphereRange& queries : parts) {
          const auto pair = CoarseLook::look_near(chain.view(), queries, {i, j});
          if (pair) expect_collides(chain, queries, *pair);
          if (queries.contains(i) && !chain.neighbours(i, j) && reference::overlap(chain[i], chain[j])) {
            EXPECT_TRUE(pair) << i << ' ' << j;
          }
        }
      }
}

TEST(CoarseLook, GivesOnlyPairsThatCollideAndFindsThoseOfAScene) {
  std::uint32_t found = 0;
  for (const char* input : {"path1:n=30000", "yarn:n=30000", "coincident:n=20000", "coil:n=30000",
                            "rod:n=30000", "hair:n=30000"}) {
    const Chain chain = open_input(input).animation->frame(0);
    CoarseLook look;
    for (const SphereRange& queries : {SphereRange{}, SphereRange{0, 10}, SphereRange{5000, 25000}}) {
      const auto pair = look.look(chain.view(), queries);
      if (!pair) continue;
      ++found;
      EXPECT_LT(pair->i, pair->j);
      EXPECT_TRUE(queries.contains(pair->i));
      EXPECT_TRUE(Robust::overlap(chain[pair->i], chain[pair->j])) << input;
      EXPECT_FALSE(chain.neighbours(pair->i, pair->j)) << input;
      EXPECT_NE(std::string(input).substr(0, 4), "coil");
    }
    EXPECT_EQ(look.look(chain.view(), {}).has_value(), find(chain, {Request::Want::counts}).found) << input;
  }
  EXPECT_GE(found, 4u);
}

}  // namespace
}  // namespace catena

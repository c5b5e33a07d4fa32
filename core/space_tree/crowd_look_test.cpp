#include "catena/core/space_tree/crowd_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/default_floats.h"
#include "catena/core/input/input.h"
#include "catena/properties/generators/dice.h"

namespace catena {
namespace {

constexpr double others = 12, deviations = 2;

Sphere anywhere(properties::Dice& dice, float room) {
  return {room * dice.symmetric(), room * dice.symmetric(), room * dice.symmetric(), 0.5f};
}

/// Balls of a walk: step 1, within `room` of the origin along each axis.
std::vector<Sphere> walk(std::uint32_t n, float room) {
  properties::Dice dice(3);
  std::vector<Sphere> spheres{{0, 0, 0, 0.5f}};
  while (spheres.size() < n) {
    Sphere next = spheres.back();
    float* const at[] = {&next.x, &next.y, &next.z};
    float& along = *at[dice.between(0, 2)];
    along += dice.one_in(2) ? 1.0f : -1.0f;
    if (along > room) along -= 2;
    if (along < -room) along += 2;
    spheres.push_back(next);
  }
  return spheres;
}

bool crowded(std::vector<Sphere> spheres, Strands strands = {}) {
  const Chain chain(std::move(spheres), std::move(strands));
  CrowdLook look;
  return look.everywhere(chain.view(), others, deviations);
}

TEST(CrowdLook, TellsWhatIsCrowdedEverywhereFromWhatIsSoInPart) {
  for (const std::uint32_t n : {3000u, 30'000u, 300'000u}) {
    properties::Dice dice(n);
    const float full = 0.5f * std::cbrt(static_cast<float>(n));
    std::vector<Sphere> dust, line;
    for (std::uint32_t i = 0; i < n; ++i) dust.push_back(anywhere(dice, full));
    for (std::uint32_t i = 0; i < n; ++i) line.push_back({static_cast<float>(i), 0, 0, 0.5f});
    EXPECT_TRUE(crowded(dust)) << n;
    EXPECT_TRUE(crowded(walk(n, 0.7f * full))) << n;
    EXPECT_FALSE(crowded(line)) << n;
    EXPECT_FALSE(crowded(walk(n, 1e6f))) << n;
    // A tube that winds through all of a box is near little of itself.
    std::vector<Sphere> rows;
    const auto side = static_cast<std::uint32_t>(2 * full);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t row = i / side, x = row % 2 == 0 ? i % side : side - 1 - i % side;
      const std::uint32_t layer = row / side, y = layer % 2 == 0 ? row % side : side - 1 - row % side;
      rows.push_back(
          {static_cast<float>(x), 1.1f * static_cast<float>(y), 1.1f * static_cast<float>(layer), 0.5f});
    }
    EXPECT_FALSE(crowded(rows)) << n;
    std::vector<Sphere> part = dust;
    for (std::uint32_t i = 0; i < n / 4; ++i) part[i] = {static_cast<float>(i) / 64, 15 * full, 0, 0.05f};
    EXPECT_FALSE(crowded(part)) << n;
  }
}

/// The first few that are looked at may by chance meet none of what nearly all others do.
TEST(CrowdLook, HoldsFewerForChanceWhereItIsToBeSurer) {
  constexpr std::uint32_t n = 300'000, chains = 60, of_a_rod = 60;
  int sure = 0, surer = 0;
  for (std::uint32_t seed = 1; seed <= chains; ++seed) {
    properties::Dice dice(seed);
    std::vector<Sphere> rods;  // in which a block meets somewhat more than `others`
    while (rods.size() < n) {
      Sphere at = anywhere(dice, 18);
      for (std::uint32_t k = 0; k < of_a_rod; ++k, at.x += 1) rods.push_back(at);
    }
    const Chain chain(std::move(rods));
    CrowdLook look;
    const bool by_two = look.everywhere(chain.view(), others, 2),
               by_three = look.everywhere(chain.view(), others, 3);
    EXPECT_LE(by_two, by_three) << seed;
    sure += by_two, surer += by_three;
  }
  EXPECT_LT(sure, surer);
}

/// Where the chain jumps now and then, only what it jumps over is met by what goes there.
TEST(CrowdLook, PassesOverAFewJumps) {
  constexpr std::uint32_t n = 30'000;
  properties::Dice dice(7);
  std::vector<Sphere> jumps, strands;
  Strands ends{{0}, {}};
  while (jumps.size() < n) {
    Sphere at = anywhere(dice, 60);
    for (int k = 0; k < 60 && jumps.size() < n; ++k, at.x += 1) jumps.push_back(at);
    ends.first.push_back(static_cast<std::uint32_t>(jumps.size()));
  }
  EXPECT_FALSE(crowded(jumps));
  EXPECT_FALSE(crowded(jumps, ends)) << "the ends of strands are in no block together";
}

/// What blocks of a finely sampled tube meet are its neighbours.
TEST(CrowdLook, CountsNoNeighbours) {
  std::vector<Sphere> fine;
  for (std::uint32_t i = 0; i < 3000; ++i) fine.push_back({0.002f * static_cast<float>(i), 0, 0, 0.5f});
  CrowdLook look;
  for (const Exclusion& rule : {Exclusion::arc(1.6), Exclusion::index(800)})
    EXPECT_FALSE(look.everywhere(Chain(fine, {}, rule).view(), others, deviations));
  EXPECT_TRUE(look.everywhere(Chain(fine).view(), others, deviations));
}

/// The first sphere and one or two others are near all, which is seldom met by chance: few blocks are near
/// many.
TEST(CrowdLook, TakesNoPeriodForTheChain) {
  int crowds = 0, chains = 0;
  for (const std::uint32_t period : {2000u, 4000u, 10'000u})
    for (std::uint32_t n = std::max(period, 2100u); n <= 3 * period; n += period / 8, ++chains) {
      std::vector<Sphere> spheres;
      for (std::uint32_t i = 0; i < n; ++i)
        spheres.push_back({static_cast<float>(i), 0, 0, i % period == 0 ? 1e5f : 0.4f});
      crowds += crowded(spheres);
    }
  EXPECT_LT(10 * crowds, chains);
}

/// Wherever it lies: a block of the sample, too, is one block.
TEST(CrowdLook, TakesNoGreatBallForACrowd) {
  constexpr std::uint32_t n = 12'000;
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.4f});
  for (std::uint32_t great = 0; great < n; great += 4) {
    const float radius = std::exchange(spheres[great].radius, 1e5f);
    EXPECT_FALSE(crowded(spheres)) << great;
    spheres[great].radius = radius;
  }
}

/// The squares of what is least are none in binary32.
TEST(CrowdLook, TellsACrowdOfMostUnlikeRadii) {
  for (const std::string shells : {"30", "60", "100", "140"}) {
    const auto cluster = open_input("cluster:n=20000,shells=" + shells).animation->frame(0);
    std::vector<Sphere> covered(cluster.spheres().begin(), cluster.spheres().end());
    for (std::size_t i = 0; i < covered.size(); i += 40) covered[i] = covered[0];
    CrowdLook look;
    EXPECT_TRUE(look.everywhere(Chain(covered).view(), others, deviations)) << shells;
    EXPECT_TRUE(DefaultFloats::stands());
  }
}

TEST(CrowdLook, IsNotTakenAtFewSpheres) {
  properties::Dice dice(1);
  std::vector<Sphere> few;
  for (int i = 0; i < 2048; ++i) few.push_back(anywhere(dice, 4));
  EXPECT_FALSE(crowded(few));
  few.push_back(few.front());
  EXPECT_TRUE(crowded(few));
}

}  // namespace
}  // namespace catena

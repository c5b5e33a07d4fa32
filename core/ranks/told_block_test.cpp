#include "catena/core/ranks/told_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/hierarchy/box_around.h"

namespace catena::ranks {
namespace {

ToldBlock around(const std::vector<Sphere>& block) {
  ToldBlock told = ToldBlock::along(7, block);
  told.hold(block);
  return told;
}

/// Up to eight spheres along a line, bent a little or not at all, of radii alike or not, far from the origin
/// or near it, of any size.
std::vector<Sphere> some_block(std::mt19937& dice) {
  std::uniform_real_distribution<float> unit(-1, 1);
  const float scale = std::exp2(static_cast<float>(static_cast<int>(dice() % 200)) - 100),
              step = dice() % 3 == 0 ? 0 : unit(dice), bend = dice() % 2 == 0 ? 0 : 0.2f,
              far = dice() % 2 == 0 ? 0 : 100;
  const float way[] = {unit(dice), unit(dice), unit(dice)}, from[] = {unit(dice), unit(dice), unit(dice)};
  std::vector<Sphere> spheres;
  const std::uint32_t size = 1 + dice() % 8;
  const bool alike = dice() % 2 == 0;
  for (std::uint32_t k = 0; k < size; ++k) {
    const auto at = [&](int d) {
      return scale * (from[d] + far + static_cast<float>(k) * step * way[d] + bend * unit(dice));
    };
    spheres.push_back({at(0), at(1), at(2), scale * (alike ? 0.5f : std::abs(unit(dice)))});
  }
  return spheres;
}

/// A sphere that touches one of these, or nearly so: its centre about as far away as both radii say.
Sphere about_touching(std::mt19937& dice, const std::vector<Sphere>& block) {
  std::normal_distribution<float> normal;
  const Sphere& s = block[dice() % block.size()];
  const float radius = s.radius * std::exp2(static_cast<float>(dice() % 12) - 6), x = normal(dice),
              y = normal(dice), z = normal(dice), apart = (s.radius + radius) * (1 + 1e-7f * normal(dice)),
              part = apart / std::sqrt(x * x + y * y + z * z);
  return {s.x + part * x, s.y + part * y, s.z + part * z, radius};
}

TEST(ToldBlock, HoldsWhatTouchesASphereOfIt) {
  std::mt19937 dice(5);
  std::size_t touching = 0, left_out = 0;
  for (int round = 0; round < 20'000; ++round) {
    const std::vector<Sphere> block = some_block(dice);
    const ToldBlock told = around(block);
    const Box box = told.box();
    for (const Sphere& s : block) {
      EXPECT_TRUE(told.may_touch(s));
      const Box of_sphere = Box::around(s);
      EXPECT_TRUE(box.meets(of_sphere));
    }
    for (int k = 0; k < 8; ++k) {
      const Sphere other = about_touching(dice, block);
      bool touches = false;
      for (const Sphere& s : block) touches = touches || Robust::overlap(s, other);
      touching += touches, left_out += !told.may_touch(other);
      if (touches) {
        ASSERT_TRUE(told.may_touch(other) && box.meets(Box::around(other))) << round;
      }
    }
  }
  EXPECT_GT(touching, 40'000u);
  EXPECT_GT(left_out, 10'000u);
}

/// A length to the nearest place on the axis, in more digits than ToldBlock has, and the radius.
long double reach_of(const ToldBlock& told, const Sphere& s) {
  long double axis[3], to[3], square = 0, along = 0, length = 0;
  const float centre[] = {s.x, s.y, s.z};
  for (int d = 0; d < 3; ++d) {
    axis[d] = static_cast<long double>(told.last[d]) - told.first[d];
    to[d] = static_cast<long double>(centre[d]) - told.first[d];
    square += axis[d] * axis[d], along += axis[d] * to[d];
  }
  const long double part = square > 0 ? std::clamp(along / square, 0.0L, 1.0L) : 0;
  for (int d = 0; d < 3; ++d) length += std::pow(to[d] - part * axis[d], 2.0L);
  return std::sqrt(length) + s.radius;
}

TEST(ToldBlock, HasTheLeastRadiusThatHoldsItsSpheres) {
  std::mt19937 dice(3);
  for (int round = 0; round < 5'000; ++round) {
    const std::vector<Sphere> block = some_block(dice);
    const ToldBlock told = around(block);
    long double least = 0;
    for (const Sphere& s : block) least = std::max(least, reach_of(told, s));
    ASSERT_GE(told.radius, least) << round;
    ASSERT_LE(told.radius, least * (1 + 0x1p-20L)) << round;
  }
}

/// A tiny sphere and a great one that touch by less than what a binary64 rounds away of their distance.
TEST(ToldBlock, HoldsWhatTouchesByLessThanRounding) {
  std::mt19937 dice(17);
  std::uniform_real_distribution<float> unit(0.5f, 1);
  std::size_t touching = 0;
  for (int round = 0; round < 1'000'000; ++round) {
    // Squares of so unlike numbers have a sum that binary64 rounds.
    const float x = unit(dice), y = 0x1p-9f * unit(dice), z = 0x1p-13f * unit(dice);
    const long double lx = x, ly = y, lz = z, apart = std::sqrt(lx * lx + ly * ly + lz * lz);
    float radius = static_cast<float>(apart);
    if (radius > apart) radius = std::nextafter(radius, 0.0f);
    const auto tiny = static_cast<float>(apart - radius);
    if (tiny > 0x1p-33f) continue;
    const ToldBlock told = around({{0, 0, 0, tiny}});
    const Sphere other{x, y, z, radius};
    if (!Robust::overlap({0, 0, 0, tiny}, other)) continue;
    ++touching;
    ASSERT_TRUE(told.may_touch(other)) << round;
  }
  EXPECT_GT(touching, 100u);
}

/// Points so near the axis, beside its length, that binary64 rounds away much of how far: of Fibonacci's
/// numbers they are one over its length away.
TEST(ToldBlock, HoldsWhatLiesNearerToItsAxisThanRounding) {
  std::vector<float> fibonacci{1, 1};
  while (fibonacci.size() < 36) fibonacci.push_back(fibonacci.end()[-1] + fibonacci.end()[-2]);
  for (std::size_t n = 24; n < fibonacci.size(); ++n)
    for (const std::size_t k : {n - 1, n - 2})
      for (const int axis : {0, 1, 2}) {
        const auto point = [&](std::size_t m) {
          const float a = fibonacci[m], b = fibonacci[m - 1];
          return axis == 0 ? Sphere{a, b, 0, 0} : axis == 1 ? Sphere{b, 0, a, 0} : Sphere{0, -a, b, 0};
        };
        const ToldBlock told = around({{0, 0, 0, 0}, point(k), point(n)});
        ASSERT_GE(told.radius, reach_of(told, point(k))) << n << ' ' << k;
      }
}

/// Along a diagonal a box would be empty but for its diagonal.
TEST(ToldBlock, LeavesOutWhatLiesBesideADiagonal) {
  std::vector<Sphere> block;
  for (int k = 0; k < 8; ++k)
    block.push_back({1.0f * static_cast<float>(k), 1.0f * static_cast<float>(k), 0, 1});
  const ToldBlock told = around(block);
  EXPECT_NEAR(told.radius, 1, 1e-6);
  EXPECT_TRUE(box_around(block).meets(Box::around({6, 1, 0, 1})));
  EXPECT_FALSE(told.may_touch({6, 1, 0, 1}));
  EXPECT_TRUE(told.may_touch({4, 3, 0, 1}));
  EXPECT_FALSE(told.may_touch({10, 10, 0, 1}));  // beyond the end
  EXPECT_FALSE(told.may_touch({-3, -3, 0, 1}));  // before the first
  EXPECT_TRUE(told.may_touch({8, 8, 0, 1}));
}

/// Where binary32 has no numbers for the radius all may touch.
TEST(ToldBlock, MayTouchAllWhereItsRadiusIsInfinite) {
  const float most = 3e38f;
  const std::vector<Sphere> block{{-most, 0, 0, most}, {0, most, 0, most}, {most, -most, 0, most}};
  const ToldBlock told = around(block);
  EXPECT_TRUE(told.may_touch({0, 0, most, 0}));
  EXPECT_TRUE(told.box().meets(Box::around({most, most, most, 0})));
}

}  // namespace
}  // namespace catena::ranks

#include "catena/core/plan/row_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace catena {
namespace {

constexpr std::uint32_t numbers[] = {32, 40, 100, 127, 128, 129, 1000, 2048, 100'003};

/// Rows that are near all others: all but itself and the two beside it, of rows that have two.
TEST(RowLook, CountsAllRowsWhereAllAreNear) {
  for (const std::uint32_t n : numbers) {
    std::vector<Sphere> spheres(n, {1, 2, 3, 0.5f});
    const std::uint32_t rows = n / 8;
    const RowLook look = RowLook::at(spheres, 0);
    EXPECT_GE(look.near, rows - 3) << n;
    EXPECT_LE(look.near, rows - 2) << n;
    EXPECT_EQ(look.straight, 1) << "nothing was gone";
  }
}

TEST(RowLook, OfAStraightChainIsNone) {
  for (const std::uint32_t n : numbers) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.9f});
    const RowLook look = RowLook::at(spheres, 0);
    EXPECT_EQ(look.near, 0) << n;
    EXPECT_EQ(look.straight, 1) << n;
  }
}

/// Too few to say anything.
TEST(RowLook, OfFewerThanFourRowsIsTheDefault) {
  const std::vector<Sphere> spheres(31, {0, 0, 0, 1});
  for (std::size_t n = 0; n <= spheres.size(); ++n)
    EXPECT_EQ(RowLook::at(std::span(spheres).first(n), 0).near, 0);
}

/// Rows of which each is near those up to so many away, and no others: what is near along the chain is not
/// missed, however long the chain is. Twelve looks tell it to within some of them.
TEST(RowLook, FindsWhatIsNearAlongTheChain) {
  for (const std::uint32_t n : {1000u, 2048u, 100'003u})
    for (const float away : {3.f, 10.f, 40.f}) {
      std::vector<Sphere> spheres;
      for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i / 8), 0, 0, away / 2});
      const RowLook look = RowLook::at(spheres, 2 * (away - 1));
      EXPECT_GE(look.near, 0.5 * 2 * (away - 1)) << n << ' ' << away;
      EXPECT_LE(look.near, 1.6 * 2 * (away - 1)) << n << ' ' << away;
    }
}

/// One of the three spheres that are looked at, by its place on any axis or by its radius, is where all rows
/// are near one another.
TEST(RowLook, TakesEachOfTheSpheresThatItLooksAt) {
  constexpr std::uint32_t rows = 50;
  for (const std::uint32_t near : {0u, 4u, 7u})
    for (float Sphere::*const axis : {&Sphere::x, &Sphere::y, &Sphere::z})
      for (const float side : {1.f, -1.f}) {
        std::vector<Sphere> reaching, thick;
        for (std::uint32_t i = 0; i < 8 * rows; ++i) {
          Sphere s{0, 0, 0, 0.1f};
          s.*axis = side * 100 * static_cast<float>(i / 8 + 1);
          thick.push_back(s), reaching.push_back(s);
          if (i % 8 == near) thick.back().radius = 1e4f, reaching.back().*axis = 0;
        }
        EXPECT_GE(RowLook::at(reaching, 0).near, rows - 3) << near << ' ' << side;
        EXPECT_GE(RowLook::at(thick, 0).near, rows - 3) << near;
      }
}

/// To and fro across the way, along whichever axis: eight steps of the fourteen lead on.
TEST(RowLook, SeesEveryAxis) {
  for (float Sphere::*const on : {&Sphere::x, &Sphere::y, &Sphere::z})
    for (float Sphere::*const across : {&Sphere::x, &Sphere::y, &Sphere::z}) {
      if (on == across) continue;
      std::vector<Sphere> spheres(400, {0, 0, 0, 0.1f});
      for (std::size_t i = 0; i < spheres.size(); ++i)
        spheres[i].*on = -static_cast<float>(i), spheres[i].*across = static_cast<float>(i % 2);
      EXPECT_DOUBLE_EQ(RowLook::at(spheres, 0).straight, 8.0 / 14);
    }
}

/// Rows along a diagonal, side by side, in boxes that meet: only lines tell whether they do.
TEST(RowLook, TellsRowsThatPassOneAnotherApart) {
  constexpr std::uint32_t strands = 16, size = 64;
  const auto bundle = [](float apart, float bend) {
    std::vector<Sphere> spheres;
    for (std::uint32_t s = 0; s < strands; ++s)
      for (std::uint32_t i = 0; i < size; ++i) {
        const auto along = static_cast<float>(i), aside = apart * static_cast<float>(s);
        spheres.push_back({along + aside, along - aside, along + (i % 8 == 4 ? bend : 0), 0.5f});
      }
    return spheres;
  };
  EXPECT_EQ(RowLook::at(bundle(1, 0), 4).near, 0);
  EXPECT_GT(RowLook::at(bundle(0.6f, 0), 4).near, 1);
  EXPECT_GT(RowLook::at(bundle(1, 6), 4).near, 1) << "thick ones";
  // Across one another, at a distance of one.
  std::vector<Sphere> crossing;
  for (std::uint32_t k = 0; k < 400; ++k) {
    const auto along = static_cast<float>(k % 8) - 3.5f, level = static_cast<float>(k / 8);
    const bool turned = k / 8 % 2 != 0;
    crossing.push_back({turned ? -along : along, along, 0.02f * level, 0.5f});
  }
  EXPECT_GT(RowLook::at(crossing, 4).near, 40);
}

/// On average over chains of many lengths it is what is near, to some hundredths: neither the nearest of a
/// stretch stands for all of it, nor one side for both.
TEST(RowLook, IsRightOnAverage) {
  constexpr float away = 24;
  double near = 0, all = 0;
  for (std::uint32_t rows = 200; rows < 400; ++rows) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < 8 * rows; ++i)
      spheres.push_back({static_cast<float>(i / 8), 0, 0, away / 2});
    near += RowLook::at(spheres, 0).near;
    for (std::uint32_t k = 0; k < rows; ++k)  // those beside it left out
      all += (std::min(away, static_cast<float>(k)) + std::min(away, static_cast<float>(rows - 1 - k)) -
              (k > 0) - (k + 1 < rows)) /
             rows;
  }
  EXPECT_NEAR(near / all, 1, 0.12);
}

/// By some rows, so that a few short chains of hundreds are taken for what they are not.
TEST(RowLook, TellsAnOrderFromNone) {
  constexpr int chains = 200;
  for (const std::uint32_t n : {100u, 1000u, 100'000u}) {
    int walks = 0, gases = 0;
    for (unsigned seed = 0; seed < (n > 1000 ? 1 : chains); ++seed) {
      std::mt19937 dice(seed);
      std::normal_distribution<float> step;
      std::vector<Sphere> walk{{0, 0, 0, 0.1f}}, gas;
      for (std::uint32_t i = 0; i < n; ++i) {
        const Sphere& s = walk.back();
        walk.push_back({s.x + step(dice), s.y + step(dice), s.z + step(dice), 0.1f});
        gas.push_back({step(dice), step(dice), step(dice), 0.1f});
      }
      walks += 0.25 > RowLook::at(walk, 0).straight;
      gases += 0.25 < RowLook::at(gas, 0).straight;
    }
    EXPECT_LT(walks, chains / 5) << n;
    EXPECT_LT(gases, chains / 10) << n;
  }
}

/// Rods of which none is near another, in no order: rows that go on in the next strand would reach across
/// all.
TEST(RowLook, OfStrandsEndsWhereTheyEnd) {
  for (const std::uint32_t length : {3u, 5u, 7u, 8u, 9u, 20u, 61u}) {
    constexpr std::uint32_t rods = 200;
    std::vector<Sphere> spheres;
    std::vector<std::uint32_t> first{0};
    for (std::uint32_t s = 0; s < rods; ++s) {
      const std::uint32_t at = s * 77 % rods;
      for (std::uint32_t k = 0; k < length; ++k)
        spheres.push_back(
            {static_cast<float>(3 * (at % 15)), static_cast<float>(3 * (at / 15)), static_cast<float>(k), 1});
      first.push_back(static_cast<std::uint32_t>(spheres.size()));
    }
    const RowLook look = RowLook::at(spheres, 4, first);
    EXPECT_EQ(look.near, 0) << length;
    EXPECT_EQ(look.straight, 1) << length;
    if (length < 20 && length != 8) {
      EXPECT_GT(RowLook::at(spheres, 4).near, 4) << length << ", as one strand";
    }
  }
}

/// A strand each of eight times as many rows where they are single spheres, each near eight times as many.
TEST(RowLook, CountsShortRowsForMore) {
  constexpr std::uint32_t rows = 50;
  const std::vector<Sphere> spheres(8 * rows, {1, 2, 3, 0.5f});
  for (const std::uint32_t length : {1u, 2u, 4u, 8u}) {
    std::vector<std::uint32_t> first;
    for (std::uint32_t i = 0; i <= spheres.size(); i += length) first.push_back(i);
    const double times = 8.0 / length;
    EXPECT_NEAR(RowLook::at(spheres, 0, first).near, times * times * RowLook::at(spheres, 0).near, 1e-9);
  }
}

/// The first sphere is near all, or each thousandth is: what few are is not what most are.
TEST(RowLook, AndItsNumbersBeginNowhereInParticular) {
  for (const std::uint32_t period : {1000u, 2000u, 5000u})
    for (std::uint32_t n = 1000; n <= 2000; n += 8) {
      std::vector<Sphere> spheres;
      for (std::uint32_t i = 0; i < n; ++i)
        spheres.push_back({static_cast<float>(i), 0, 0, i % period == 0 ? 1e4f : 0.4f});
      EXPECT_LT(RowLook::at(spheres, 24).near, 24) << n << ' ' << period;
    }
}

/// Far jumps, between strands say, are no way of the chain.
TEST(RowLook, IsStraightAsMostRowsAre) {
  std::mt19937 dice(5);
  std::normal_distribution<float> step;
  std::vector<Sphere> arms, clusters;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto far = static_cast<float>(1000 * (i / 50 % 7)), along = static_cast<float>(i % 50);
    arms.push_back({far + along, far, far - along, 0.1f});
    clusters.push_back({far + step(dice), far + step(dice), step(dice), 0.1f});
  }
  EXPECT_NEAR(RowLook::at(arms, 0).straight, 1, 0.1);
  EXPECT_LT(RowLook::at(clusters, 0).straight, 0.25);
}

}  // namespace
}  // namespace catena

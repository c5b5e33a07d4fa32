#include "catena/core/frames/moving_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/chain/chain.h"

namespace catena {
namespace {

/// At numbers of runs about those that bits of a vector can tell apart one by one.
TEST(MovingRow, FindsThePairsOfRunsThatChangedInRowsOfAnyLength) {
  std::mt19937 random(2);
  for (const std::uint32_t runs : {1u, 2u, 128u, 129u, 256u, 257u, 512u, 513u, 1024u, 1025u})
    for (const std::uint32_t left : {1u, 8u}) {
      const std::uint32_t n = 8 * (runs - 1) + left;
      std::vector<Sphere> spheres(n, Sphere{0, 0, 0, 1});
      MovingRow row;
      row.hold(spheres);
      const std::uint32_t some = random() % n;
      const std::vector<SphereRange> ranges{{some, some + 1}, {n - 1, n}};
      row.move(spheres, ranges);
      std::vector<Pair> pairs;
      for (std::uint32_t k = 0; k < 300; ++k) {
        const std::uint32_t i = random() % n, j = k % 20 == 0 ? n - 1 : random() % n;
        pairs.push_back({std::min(i, j), std::max(i, j)});
      }
      std::vector<std::uint32_t> found, right;
      row.find_changed(pairs, found);
      for (std::uint32_t k = 0; k < pairs.size(); ++k)
        for (const std::uint32_t run : {some / 8, (n - 1) / 8})
          if ((pairs[k].i / 8 == run || pairs[k].j / 8 == run) && (right.empty() || right.back() != k))
            right.push_back(k);
      EXPECT_EQ(found, right) << n;
    }
}

/// A film of shifts to and fro, past the ends of the row too, and of ranges that move: after each frame the
/// row is the frame, what is said to have changed has all that did, and what is found are the pairs of that.
TEST(MovingRow, FollowsAFilm) {
  std::uint64_t collided = 0, kept = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(0, 12), radius(0.2f, 1);
    const auto any = [&] { return Sphere{place(random), place(random), place(random), radius(random)}; };
    const auto n = static_cast<std::uint32_t>(20 + random() % 200);
    std::vector<Sphere> now(n);
    std::ranges::generate(now, any);
    MovingRow row;
    row.hold(now);
    std::vector<Pair> found, all;
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = i + 1; j < n; ++j) all.push_back({i, j});
    for (int frame = 0; frame < 25; ++frame) {
      std::vector<bool> differs(n);  // from the sphere that was in its place of the row
      if (random() % 2) {
        const auto s = static_cast<std::int64_t>(random() % (n / 2)) - n / 4;
        const std::vector<Sphere> before = now;
        for (std::uint32_t i = 0; i < n; ++i) {
          const std::int64_t from = i + s;
          differs[i] = from < 0 || from >= n;
          now[i] = differs[i] ? any() : before[static_cast<std::size_t>(from)];
        }
        row.shift(now, s);
      } else {
        std::vector<SphereRange> ranges;
        for (std::uint32_t at = random() % n; at < n; at += random() % n + 1) {
          const std::uint32_t end = std::min(n, at + 1 + static_cast<std::uint32_t>(random() % 9));
          ranges.push_back({at, end});
          for (; at < end; ++at) now[at] = any(), differs[at] = true;
        }
        row.move(now, ranges);
      }
      ASSERT_TRUE(std::ranges::equal(row.spheres(), now)) << seed << ' ' << frame;
      const Chain chain(now);
      std::vector<std::uint32_t> places;
      row.find_changed(all, places);
      ASSERT_TRUE(std::ranges::is_sorted(places));
      std::vector<Pair> right;
      for (std::uint32_t k = 0; k < all.size(); ++k) {
        const auto [i, j] = all[k];
        const bool said = std::ranges::binary_search(places, k);
        ASSERT_TRUE(said || !(differs[i] || differs[j])) << seed << ' ' << frame;
        if (said && j != i + 1 && ExactSign::of_gap(now[i], now[j]) <= 0) right.push_back(all[k]);
        kept += !said;
      }
      row.search(chain.view(), found, random() % 2 == 0);
      std::ranges::sort(found);
      ASSERT_EQ(found, right) << seed << ' ' << frame;
      collided += right.size();
    }
  }
  EXPECT_GT(collided, 1000u);
  EXPECT_GT(kept, 10'000u);
}

/// Of what moves onto one point pairs are as many as its square: no more are found than there is room for.
TEST(MovingRow, EndsWhereThereAreTooManyPairs) {
  std::vector<Sphere> spheres(4000);
  for (std::uint32_t i = 0; i < 4000; ++i) spheres[i] = {static_cast<float>(i), 0, 0, 0.6f};
  const std::vector<SphereRange> ranges{{1000, 2000}};
  for (const bool by_cells : {false, true}) {
    MovingRow row;
    row.hold(spheres);
    std::vector<Sphere> moved = spheres;
    for (std::uint32_t i = 1000; i < 2000; ++i) i % 2 ? void(moved[i] = spheres[1500]) : void(moved[i].y = 5);
    row.move(moved, ranges);
    const Chain chain(moved);
    std::vector<Pair> found;
    constexpr std::size_t most = 1000, a_little = 1 << 14, all = 500 * 499 / 2;
    EXPECT_EQ(row.search(chain.view(), found, by_cells, most), by_cells);
    EXPECT_GT(found.size(), most);
    EXPECT_LT(found.size(), most + a_little);
    static_assert(most + a_little < all);
    row.move(spheres, ranges);  // and it goes on
    EXPECT_EQ(row.search(Chain(spheres).view(), found, by_cells, most), by_cells);
    EXPECT_TRUE(found.empty());
  }
}

/// Spheres that touch within a unit of the last place, each alone with points in its run.
TEST(MovingRow, MeetsEveryTwoThatTouch) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.1f, 1);
  std::vector<Sphere> spheres;
  std::vector<SphereRange> ranges;
  std::vector<Pair> right;
  for (std::uint32_t k = 0; k < 300; ++k) {
    const auto y = 16 * static_cast<float>(k);
    const Sphere a{unit(random), y, 0, unit(random)};
    Sphere b{0, y, 0, unit(random)};
    b.x = std::nextafter(a.x + a.radius + b.radius, 9.0f);
    while (ExactSign::of_gap(a, b) > 0) b.x = std::nextafter(b.x, 0.0f);
    ranges.push_back({16 * k, 16 * k + 8});
    right.push_back({16 * k, 16 * k + 8});
    for (const Sphere& s : {a, b}) {
      spheres.push_back(s);
      spheres.insert(spheres.end(), 7, Sphere{s.x, y, 0, 0});
    }
  }
  const Chain chain(spheres, {}, Exclusion::index(7));  // the points of a run are neighbours of its sphere
  for (const bool by_cells : {false, true}) {
    MovingRow row;
    row.hold(spheres);
    row.move(spheres, ranges);
    std::vector<Pair> found;
    EXPECT_EQ(row.search(chain.view(), found, by_cells), by_cells);
    std::ranges::sort(found);
    EXPECT_TRUE(std::ranges::includes(found, right)) << by_cells;
  }
}

}  // namespace
}  // namespace catena

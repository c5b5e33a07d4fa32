#include "catena/reference/find_in_box.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "catena/core/error.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/rational_image.h"

namespace catena::reference {
namespace {

Collisions found(const Chain& chain, const PeriodicBox& box) {
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), box);
  Collisions result;
  periodic.build(chain);
  periodic.find(chain, {}, result);
  std::ranges::sort(result.pairs);
  return result;
}

/// Edges of 4 to 32, or none; tilts of up to half an edge; all multiples of a quarter, so that spheres touch
/// exactly.
PeriodicBox any_box() {
  const auto quarters = [](int from, int to) { return *rc::gen::inRange(from, to) / 4.0; };
  PeriodicBox box;
  for (double& length : box.length)
    length = *rc::gen::weightedElement<int>({{4, 1}, {1, 0}}) * quarters(24, 128);
  box.length[*rc::gen::inRange<std::size_t>(0, 3)] = quarters(24, 128);
  if (*rc::gen::arbitrary<bool>())
    box.xy = quarters(-8, 9), box.xz = quarters(-8, 9), box.yz = quarters(-8, 9);
  return box;
}

// Two ways to the definition that share nothing: cells of the box here, ghosts of a chain there.
RC_GTEST_PROP(FindInBox, AgreesWithASearchAmongImages, ()) {
  const PeriodicBox box = any_box();
  std::vector<Sphere> spheres;
  const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(-300, 300)) / 4; };
  for (auto left = *rc::gen::inRange(1, 60); left > 0; --left)
    spheres.push_back(
        {coordinate(), coordinate(), coordinate(), *rc::gen::element(0.0f, 0.25f, 0.75f, 1.0f)});
  const auto n = static_cast<std::uint32_t>(spheres.size());
  const Chain chain(std::move(spheres), {{0, n}, {*rc::gen::arbitrary<bool>()}});
  const Collisions expected = found(chain, box);
  RC_CLASSIFY(expected.pair_count > 0, "pairs");
  const Answer answer = find_in_box(chain, box, 1000000);
  RC_ASSERT(answer.has_pairs);
  RC_ASSERT(answer.pairs == expected.pairs);
  RC_ASSERT(answer.count == expected.count);
  RC_ASSERT(answer.pair_count == expected.pair_count);
}

using properties::Rational;

/// q and t of the nearest of all images up to `far` boxes away.
std::pair<Rational, Rational> nearest(const Sphere& a, const Sphere& b, const PeriodicBox& box, int far) {
  const Rational reach = Rational(a.radius) + Rational(b.radius);
  return {properties::nearest_squared(a, b, box, far), reach * reach};
}

// Pairs, sides and margins are those of the definition; narrow boxes, where 0.71 of a width matters, among
// them.
RC_GTEST_PROP(FindInBox, NearPairsAreThoseOfTheDefinition, ()) {
  PeriodicBox box{{4, 4 + *rc::gen::inRange(0, 9) / 4.0, 4.1}};
  if (*rc::gen::arbitrary<bool>())
    box.xy = *rc::gen::inRange(-4, 5) / 4.0, box.length[0] += 1, box.length[1] += 1;
  if (*rc::gen::arbitrary<bool>()) box.length[2] = 0;
  std::vector<Sphere> spheres;
  const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(-40, 40)) / 8; };
  for (auto left = *rc::gen::inRange(2, 16); left > 0; --left)
    spheres.push_back(
        {coordinate(), coordinate(), coordinate() / 2, *rc::gen::element(0.0f, 0.25f, 0.7f, 1.0f)});
  const auto n = static_cast<std::uint32_t>(spheres.size());
  const Chain chain(std::move(spheres), {{0, n}, {0}});
  std::map<Pair, std::pair<bool, double>> found;
  near_pairs_in_box(chain, box, [&](const Pair& pair, bool collides, double margin) {
    RC_ASSERT(found.emplace(pair, std::pair(collides, margin)).second);
  });
  std::size_t near = 0;
  std::vector<Pair> colliding;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j) {
      if (chain.neighbours(i, j)) continue;
      const auto [q, t] = nearest(chain[i], chain[j], box, 5);
      if (q > t && q - t >= t) continue;
      RC_ASSERT(found.contains({i, j}));
      ++near;
      const auto [collides, margin] = found.at({i, j});
      RC_ASSERT(collides == (q <= t));
      if (collides) colliding.push_back({i, j});
      const double right = q == t ? 0 : static_cast<double>(Rational(abs(q - t) / t));
      RC_ASSERT(std::abs(margin - right) <= (right < 0x1p-8 ? 0x1p-52 : 0x1p-30) * right);
    }
  RC_ASSERT(found.size() == near);
  RC_ASSERT(find_in_box(chain, box, 1000000).pairs == colliding);
  RC_CLASSIFY(near > colliding.size(), "apart and near");
}

TEST(FindInBox, CountsPastTheLimitAndRefusesNarrowBoxes) {
  const Chain chain({{0, 0, 0, 1}, {4, 0, 0, 1}, {8.5f, 0, 0, 1}}, {{0, 1, 2, 3}, {0, 0, 0}});
  const PeriodicBox box{{10, 0, 0}};
  EXPECT_EQ(find_in_box(chain, box, 1).pairs, (std::vector<Pair>{{0, 2}}));
  const Answer counted = find_in_box(chain, box, 0);
  EXPECT_FALSE(counted.has_pairs);
  EXPECT_TRUE(counted.pairs.empty());
  const Chain crowd({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}}, {{0, 1, 2, 3}, {0, 0, 0}});
  for (const std::uint64_t limit : {2, 3}) {
    EXPECT_EQ(find_in_box(crowd, box, limit).pairs.size(), limit == 3 ? 3u : 0u) << "all or none";
    EXPECT_EQ(find_in_box(crowd, box, limit).pair_count, 3u);
  }
  EXPECT_EQ(counted.count, (std::vector<std::uint32_t>{1, 0, 1}));
  EXPECT_THROW(find_in_box(chain, {{3, 0, 0}}, 1), InputError);
  EXPECT_THROW(find_in_box(Chain({{1e9f, 0, 0, 1}}, {{0, 1}, {0}}), box, 1), InputError);
}

/// What is near, to within 2^-149 and to a margin of 1 exactly.
TEST(FindInBox, NearPairsEndExactly) {
  const auto near = [](const Sphere& a, const Sphere& b) {
    std::size_t found = 0;
    near_pairs_in_box(Chain({a, b}, {{0, 1, 2}, {0, 0}}), {{9, 9, 9}},
                      [&](const Pair&, bool, double) { ++found; });
    return found;
  };
  EXPECT_EQ(near({1, 2, 3, 0}, {1, 2, 3, 0}), 1u) << "two points at one place";
  EXPECT_EQ(near({1, 2, 3, 1}, {1, 2, 3, 0.5}), 1u) << "about one place, at a margin of 1";
  EXPECT_EQ(near({1, 2, 3, 1}, {10, 2, -6, 0.5}), 1u) << "boxes away";
  EXPECT_EQ(near({0, 0, 0, 0}, {0x1p-149f, 0, 0, 0}), 0u);
  for (const float step : {0x1p-53f, 0.0f, -0x1p-53f})
    EXPECT_EQ(near({step, 0, 0, 1}, {2, 2, 0, 1}), step > 0 ? 1u : 0u) << step;
}

/// In many cells, too, which are as wide as what is near.
TEST(FindInBox, NearPairsOfACrowdAreThoseOfAllPairs) {
  std::mt19937 dice(8);
  std::uniform_real_distribution<float> at(0, 10);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 1000; ++k) spheres.push_back({at(dice), at(dice), at(dice), 0.5f});
  const Chain chain(std::move(spheres));
  std::size_t expected = 0, near = 0;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 2; j < chain.size(); ++j) {
      const auto apart = [](double way) { return way - 10 * std::round(way / 10); };
      expected += std::hypot(apart(chain[i].x - chain[j].x), apart(chain[i].y - chain[j].y),
                             apart(chain[i].z - chain[j].z)) < std::sqrt(2);
    }
  near_pairs_in_box(chain, {{10, 10, 10}}, [&](const Pair&, bool, double) { ++near; });
  EXPECT_EQ(near, expected);
}

// Touching across a face, and apart by an ulp.
TEST(FindInBox, DecidesTiesExactly) {
  const auto pairs = [](float x) {
    return find_in_box(Chain({{0.5f, 0, 0, 1}, {x, 0, 0, 0.5f}}, {{0, 1, 2}, {0, 0}}), {{8, 8, 8}}, 1)
        .pair_count;
  };
  EXPECT_EQ(pairs(7.0f), 1u);
  EXPECT_EQ(pairs(std::nextafter(7.0f, 0.0f)), 0u);
}

/// A box that is hardly less than four reaches wide has three cells along it.
TEST(FindInBox, HasCellsThatAreAReachWide) {
  std::vector<Sphere> spheres{{0, 0, 0, 0.5f}, {-1, 0, 0, 0.5f}};
  while (spheres.size() < 64) spheres.push_back({0, 5, static_cast<float>(spheres.size()) / 2, 0});
  std::vector<std::uint32_t> starts(65);
  std::iota(starts.begin(), starts.end(), 0u);
  const Chain chain(std::move(spheres), {starts, {}});
  EXPECT_EQ(find_in_box(chain, {{3.98, 40, 40}}, 9).pairs, (std::vector<Pair>{{0, 1}}));
}

// 1,025 boxes on, where a product of the box's width is rounded by more than the spheres are apart.
TEST(FindInBox, DecidesExactlyManyBoxesAway) {
  const float far = 1025.0f * 2097151 + 1;
  ASSERT_EQ(static_cast<double>(far), 1025.0 * 2097151 + 1);
  for (int k = -3; k <= 3; ++k) {
    const PeriodicBox box{{2097151 + k * 0x1p-32, 0, 0}};
    for (const float more : {-0x3p-23f, 0.0f, 0x1p-23f, 0x1p-22f, 0x3p-23f}) {
      const Chain chain({{0, 0, 0, 0.5f}, {far, 0, 0, 0.5f + more}}, {{0, 1, 2}, {0, 0}});
      const bool touch = 1 - 1025 * k * 0x1p-32 <= 1 + double{more};  // all of it exact
      EXPECT_EQ(find_in_box(chain, box, 1).pair_count, touch ? 1u : 0u) << k << ' ' << more;
    }
  }
}

/// Many more spheres than cells that are as wide as they reach; another search, which shares no code with
/// this one.
TEST(FindInBox, FindsWhatASearchOfImagesFindsInACrowd) {
  std::vector<Sphere> spheres;
  std::uint32_t state = 1;
  const auto place = [&] {
    return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f * 6;
  };
  for (int k = 0; k < 2000; ++k) {
    const float x = place(), y = place(), z = place();
    spheres.push_back({x, y, z, k % 2 == 0 ? 0.5f : place() / 24});
  }
  const Chain chain(std::move(spheres));
  const PeriodicBox box{{6.6, 6.75, 7.5}, 0.5, -1, 0.25};
  Answer exact = find_in_box(chain, box, std::uint64_t{1} << 24);
  Periodic periodic(StrategyRegistry::instance().make("Grid"), box);
  Collisions found;
  periodic.build(chain);
  periodic.find(chain, {}, found);
  std::ranges::sort(found.pairs);
  EXPECT_GT(exact.pairs.size(), 10'000u);
  EXPECT_TRUE(found.pairs == exact.pairs) << found.pairs.size() << " of " << exact.pairs.size();
  EXPECT_EQ(found.count, exact.count);
}

}  // namespace
}  // namespace catena::reference

#include "catena/core/frames/kept_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "catena/core/frames/frame_search.h"
#include "catena/core/frames/moved_cells.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/scenes/random.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

void all_pairs(const Chain& chain, const Request& request, Collisions& found) {
  const auto variant = StrategyRegistry::instance().make("CPU1");
  variant->build(chain);
  variant->find(chain, request, found);
}

Chain crowd(Random& random, std::uint32_t n) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 at = 4 * random.cube();
    spheres.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z),
                       static_cast<float>(0.5 + 0.5 * random.unit())});
  }
  return Chain(std::move(spheres));
}

/// How far the sphere that sticks out most does of one that is thicker by `skin` than that of `first`.
double sticks_out(const Chain& now, const Chain& first, double skin) {
  double most = -skin;
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    const Sphere &a = now[i], &b = first[i];
    most = std::max(most, std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z) + a.radius -
                              b.radius - skin);
  }
  return most;
}

/// Spheres that drift away little by little, whatever is looked at between: the list holds until one has left
/// its thick sphere, not only its inner skin, and answers rightly until then.
TEST(KeptList, HoldsWhileEachSphereIsInItsThickOne) {
  constexpr double skin = 0.5;
  int held = 0, left = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    const Chain first = crowd(random, 60);
    std::vector<Vec3> drift;
    for (std::uint32_t i = 0; i < first.size(); ++i) drift.push_back(random.direction());
    const double step = 0.02 + 0.2 * random.unit(), inner = 0.45 * random.unit();
    KeptList list;
    ASSERT_TRUE(list.make(first, static_cast<float>(skin), static_cast<float>(inner), 1u << 20, all_pairs));
    std::vector<Pair> pairs;
    std::vector<std::uint32_t> counts;
    Chain now = first;
    for (int frame = 0;; ++frame) {
      if (frame > 0) {
        std::vector<Sphere> spheres(now.spheres().begin(), now.spheres().end());
        for (std::uint32_t i = 0; i < now.size(); ++i) {
          spheres[i].x += static_cast<float>(step * drift[i].x),
              spheres[i].y += static_cast<float>(step * drift[i].y);
          spheres[i].z += static_cast<float>(step * drift[i].z);
          spheres[i].radius *= i % 7 == 0 ? 1.01f : i % 7 == 1 ? 0.99f : 1.0f;
        }
        now = now.moved(std::move(spheres));
        const double out = sticks_out(now, first, skin);
        const bool holds = list.holds(now);
        if (out > 1e-4) {
          EXPECT_FALSE(holds) << seed << ", frame " << frame << ": out by " << out;
        } else if (out < -1e-4) {
          EXPECT_TRUE(holds) << seed << ", frame " << frame << ": in by " << -out;
        }
        if (!holds) break;
      }
      list.find(now.spheres(), pairs, counts, frame > 0);
      Collisions exact;
      all_pairs(now, {}, exact);
      std::vector<Pair> sorted = pairs;
      std::ranges::sort(sorted), std::ranges::sort(exact.pairs);
      ASSERT_EQ(sorted, exact.pairs) << seed << ", frame " << frame;
      EXPECT_EQ(counts, exact.count) << seed << ", frame " << frame;
      ++held;
    }
    ++left;
  }
  EXPECT_GT(held, 3 * left);
}

TEST(KeptList, IsOfOneChainAndHasAnEnd) {
  Random random(1);
  const Chain chain = crowd(random, 30);
  KeptList list;
  EXPECT_FALSE(list.holds(chain)) << "none was made";
  Collisions thick;
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (Sphere& s : spheres) s.radius += 0.25f;
  all_pairs(chain.moved(std::move(spheres)), {}, thick);
  EXPECT_FALSE(list.make(chain, 0.25f, 0.1f, thick.pairs.size() - 1, all_pairs));
  EXPECT_FALSE(list.made());
  EXPECT_TRUE(list.make(chain, 0.25f, 0.1f, thick.pairs.size(), all_pairs));
  EXPECT_EQ(list.size(), thick.pairs.size());
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> counts;
  EXPECT_TRUE(list.find(chain.spheres(), pairs, counts, false)) << "pruned for the first time";
  EXPECT_TRUE(list.holds(chain));
  EXPECT_FALSE(list.find(chain.spheres(), pairs, counts, true)) << "of spheres that stay where they are";
  EXPECT_FALSE(list.holds(crowd(random, 29)));
  list.drop();
  EXPECT_FALSE(list.holds(chain));
  const Chain huge({{0, 0, 0, 3e38f}, {1, 0, 0, 1}});
  EXPECT_FALSE(list.make(huge, 1e38f, 0, 9, all_pairs)) << "no radius with its skin";
  EXPECT_FALSE(list.made());
}

/// Cells have an end and a width.
TEST(MovedCells, AreOfNoUseWhereTheyWouldBeEndlessOrOfNoWidth) {
  const std::vector<std::uint32_t> moved{0, 2};
  MovedCells cells;
  EXPECT_TRUE(cells.lay_out(Chain({{0, 0, 0, 1}, {2, 0, 0, 1}, {9, 0, 0, 1}}).view(), moved));
  EXPECT_FALSE(
      cells.lay_out(Chain({{-2e38f, 0, 0, 1e38f}, {2, 0, 0, 1}, {2e38f, 0, 0, 1e38f}}).view(), moved));
  EXPECT_FALSE(
      cells.lay_out(Chain({{0, 0, 0, 1e-44f}, {0, 0, 0, 1e-44f}, {4e-44f, 0, 0, 1e-44f}}).view(), moved));
}

/// What a joint keeps apart are two spheres of the chain, not of its path: a chain that goes on along itself
/// has other pairs then, whoever says that it did.
TEST(FrameSearch, AShiftedChainOfJointsIsSearchedAnew) {
  std::vector<Sphere> path;
  for (int i = 0; i < 60; ++i)
    path.push_back({static_cast<float>(i % 10), i / 10 % 2 == 0 ? 0.0f : 1.5f, 0, 0.875f});
  Exclusion joints = Exclusion::index(1);
  joints.extra_pairs = {{3, 5}, {8, 11}, {20, 40}};
  const auto window = [&](std::size_t at) {
    return std::vector<Sphere>(path.begin() + at, path.begin() + at + 50);
  };
  Chain chain(window(0), {}, joints);
  FrameSearch search(Omissions::without({}), true);
  Collisions found;
  search.begin(true);
  search.find(chain, {}, found, all_pairs, all_pairs, 0);
  for (std::size_t at = 1; at < 10; ++at) {
    chain = chain.moved(window(at));
    search.update(chain, at % 2 == 0 ? Moved() : Moved::along(1));
    search.find(chain, {}, found, all_pairs, all_pairs, 0);
    Collisions exact;
    all_pairs(chain, {}, exact);
    std::ranges::sort(found.pairs), std::ranges::sort(exact.pairs);
    EXPECT_EQ(found.pairs, exact.pairs) << at;
  }
}

}  // namespace
}  // namespace catena

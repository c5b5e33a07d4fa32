#include "catena/bench/pivot/rotated_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

/// Where a chain is: far from the origin binary32 is coarse, and rounding alone makes spheres collide.
struct Place {
  std::uint32_t n;
  Vec3 start;
  float radius = 0.5f;
  int moves = 400;
};

RotationPivot random_move(std::uint32_t n, Random& random) {
  const auto site = static_cast<std::uint32_t>(random.unit() * (n - 1));
  return {site, random_rotation(random)};
}

std::uint64_t pairs_of(std::vector<Sphere> spheres) {
  return reference::find(Chain(std::move(spheres)), {.want = Request::Want::counts}).pair_count;
}

bool same_bits(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Sphere)) == 0;
}

/// What is wrong with a number of attempts, or nothing. Every answer is compared with that of the exact
/// reference on the spheres that the move writes, and these with the move by its definition.
template <class Rule>
std::string fault(const Place& place, std::uint64_t seed, int* by_turning_alike = nullptr) {
  RotatedChain<Rule> chain(place.n, place.radius, place.start);
  Random random(seed);
  const double extent = chain.tree().extent();
  for (int k = 0; k < place.moves; ++k) {
    const RotationPivot move = random_move(place.n, random);
    const std::vector<Sphere> before = chain.tree().spheres();
    RotationTree<Rule> turned = chain.tree();
    turned.turn(move);
    const std::vector<Sphere> after = turned.spheres();
    for (std::uint32_t i = 0; i < place.n; ++i) {
      const auto at = [&](std::uint32_t s) { return Vec3{before[s].x, before[s].y, before[s].z}; };
      const Vec3 right = i <= move.site ? at(i) : at(move.site) + move.turn(at(i) - at(move.site));
      const Vec3 is{after[i].x, after[i].y, after[i].z};
      if (!(length(is - right) <= 0x1p-20 * extent)) return "a sphere is not where the move takes it";
      if (i <= move.site && std::memcmp(&before[i], &after[i], sizeof(Sphere)) != 0)
        return "a sphere before the site moved";
      const Sphere alone = turned.sphere(i);
      if (std::memcmp(&alone, &after[i], sizeof(Sphere)) != 0)
        return "a sphere alone differs from that of the chain";
    }
    const bool right = pairs_of(after) == 0;
    if (chain.attempt(move) != right)
      return right ? "refused a move that is free of collisions" : "made a move that collides";
    if (!same_bits(chain.tree().spheres(), right ? after : before))
      return "the chain is not the one that was decided on";
    if (by_turning_alike && !right) {
      const std::vector<Sphere> moved(after.begin() + move.site + 1, after.end());
      *by_turning_alike += pairs_of(moved) > 0;
    }
  }
  return "";
}

const std::vector<Place>& places() {
  static const std::vector<Place> places{{2, {}},
                                         {3, {}},
                                         {8, {}},
                                         {9, {}},
                                         {40, {}},
                                         {40, {1e5, 0, 0}},
                                         {300, {}},
                                         {300, {-3e4, 2e5, 1e4}},
                                         {600, {0, 1e6, 0}, 0.48f},
                                         {100, {1e6, 1e6, 1e6}, 0.3f},
                                         {300, {2e5, 0, 0}, 0.1f},
                                         {17, {5e6, 5e6, 5e6}, 0.4f, 20'000}};
  return places;
}

TEST(RotatedChain, AnswersAsTheExactReferenceDoesOnTheSpheresThatAreWritten) {
  int by_turning_alike = 0;
  std::uint64_t seed = 0;
  for (const Place& place : places())
    EXPECT_EQ(fault<RotationRule>(place, ++seed, &by_turning_alike), "")
        << place.n << " from x = " << place.start.x;
  EXPECT_GT(by_turning_alike, 100) << "moves that only rounding forbids, of spheres that turn alike";
}

struct ListsOften : RotationRule {
  static double skin(double rounding) { return (1 + 0x1p-9) * rounding; }
};

/// What otherwise takes thirty thousand moves: drift that eats up the skin.
TEST(RotatedChain, AnswersTheSameWhenItListsAllPairsAnew) {
  std::uint64_t seed = 100;
  for (const Place& place : places()) EXPECT_EQ(fault<ListsOften>(place, ++seed), "") << place.n;
}

/// The same, and how often.
struct CountsLists : ListsOften {
  static inline int lists = 0;
  static double skin(double rounding) { return ++lists, ListsOften::skin(rounding); }
};

/// A list is made anew when the drifts of the moves since have eaten up its skin, and when the chain has
/// shrunk to less than a quarter: by the definition, attempt by attempt.
TEST(RotatedChain, ListsAllPairsAnewAsDriftsAndExtentsSay) {
  int by_drift = 0, by_extent = 0;
  for (const Vec3& start : {Vec3{}, Vec3{-3e4, 2e5, 1e4}}) {
    constexpr std::uint32_t n = 300;
    CountsLists::lists = 0;
    RotatedChain<CountsLists> chain(n, 0.1f, start);
    EXPECT_EQ(CountsLists::lists, 1);
    Random random(5);
    double listed = chain.tree().extent(), drift = 0, skin = ListsOften::skin(0x1p-22 * listed);
    for (int k = 0; k < 600; ++k) {
      const RotationPivot move = random_move(n, random);
      const double before = chain.tree().extent();
      auto turned = chain.tree();
      turned.turn(move);
      const double after = turned.extent(), drifted = drift + 0x1p-33 * std::max(before, after);
      const bool spent = drifted + 0x1p-22 * after >= skin;
      CountsLists::lists = 0;
      const bool made = chain.attempt(move), shrunk = made && !spent && 4 * after < listed;
      ASSERT_EQ(CountsLists::lists, spent || shrunk) << k;
      by_drift += spent, by_extent += shrunk;
      if (!made) continue;
      drift = drifted;
      if (spent || shrunk) drift = 0, listed = after, skin = ListsOften::skin(0x1p-22 * after);
    }
  }
  EXPECT_GT(by_drift, 50);
  EXPECT_GT(by_extent, 0);
}

struct BoundsWithoutSlack : RotationRule {
  static double reach(double diameter, double, double) { return diameter; }
};
struct NoNearPairs : RotationRule {
  static bool keeps(double distance, double most) {
    return RotationRule::keeps(distance, most) && distance <= 1;
  }
};
struct StaleBounds : RotationRule {
  static CentreBall renewed(const CentreBall& old, const CentreBall&) { return old; }
};
struct WrongOrder : RotationRule {
  static Rotation seen_from(const RigidMove& at, const Rotation& turn) {
    return at.turn.after(turn).after(at.turn.inverse());
  }
};

template <class Mutant>
bool dies() {
  std::uint64_t seed = 0;
  for (const Place& place : places())
    if (!fault<Mutant>(place, ++seed).empty()) return true;
  return false;
}

TEST(RotatedChainMutants, AllDie) {
  EXPECT_TRUE(dies<BoundsWithoutSlack>());
  EXPECT_TRUE(dies<NoNearPairs>());
  EXPECT_TRUE(dies<StaleBounds>());
  EXPECT_TRUE(dies<WrongOrder>());
}

TEST(RotatedChain, IsAnOrdinaryChainThatEveryExactVariantJudges) {
  RotatedChain<> chain(3000);
  Random random(7);
  int accepted = 0;
  for (int k = 0; k < 4000; ++k) accepted += chain.attempt(random_move(chain.size(), random));
  EXPECT_GT(accepted, 300);
  std::vector<Sphere> spheres = chain.tree().spheres();
  EXPECT_EQ(pairs_of(spheres), 0u);
  for (Sphere& s : spheres) s.radius = 0.75f;  // so that there is something to find
  const Chain thick(std::move(spheres));
  const auto exact = reference::find(thick);
  EXPECT_GT(exact.pair_count, 500u);
  for (const char* name : {"Hybrid", "Grid", "ChainTree", "aCPU2+CPU2", "CPU1"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    variant->build(thick);
    variant->find(thick, {}, found);
    std::ranges::sort(found.pairs);
    EXPECT_TRUE(found.pairs == exact.pairs) << name;
  }
}

/// The bound that is derived for what a move does to the distance of two spheres that it turns alike,
/// measured on places before they are rounded to binary32.
TEST(RotatedChain, DriftsByLessThanItCounts) {
  constexpr std::uint32_t n = 500;
  for (const Vec3& start : {Vec3{}, Vec3{1e5, -2e5, 1e4}}) {
    RotationTree<> tree(n, 0.5f, start);
    Random random(11);
    double worst = 0;
    const auto distances = [&] {
      std::vector<Vec3> at;
      for (std::uint32_t i = 0; i < n; ++i) at.push_back(tree.at_leaf(tree.leaf_of(i))(tree.near[i]));
      return at;
    };
    std::vector<Vec3> old = distances();
    for (int k = 0; k < 300; ++k) {
      const RotationPivot move = random_move(n, random);
      tree.turn(move);
      const std::vector<Vec3> now = distances();
      for (std::uint32_t i = move.site; i < n; i += 3)
        for (std::uint32_t j = i + 1; j < n; j += 7)
          worst =
              std::max(worst, std::fabs(length(now[j] - now[i]) - length(old[j] - old[i])) / tree.extent());
      old = now;
    }
    EXPECT_LT(worst, 0x1p-38) << "a thirtieth of what is counted";
    EXPECT_GT(worst, 0x1p-60);
  }
}

TEST(RotatedChain, RefusesWhatIsNoChain) {
  EXPECT_THROW(RotatedChain<>(1), InputError);
  EXPECT_THROW(RotatedChain<>((1u << 22) + 1), InputError);
  EXPECT_THROW(RotatedChain<>(10, 1.0f), InputError);
  EXPECT_THROW(RotatedChain<>(2, 1.0f), InputError) << "also where it has no pair but neighbours";
  EXPECT_THROW(RotatedChain<>(10, -0.5f), InputError);
  EXPECT_THROW(RotatedChain<>(10, std::nanf("")), InputError);
}

}  // namespace
}  // namespace catena::bench

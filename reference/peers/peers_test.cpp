#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "catena/core/error.h"
#include "catena/core/executor/usable_cores.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/allocations.h"
#include "catena/reference/all_pairs.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"
#include "catena/reference/testing/nasty.h"

namespace catena {

/// How gtest names a peer where it prints one, instead of its bytes.
static void PrintTo(const VariantInfo& peer, std::ostream* out) { *out << peer.name; }

}  // namespace catena

namespace catena::reference {
namespace {

std::vector<VariantInfo> peers() {
  auto all = StrategyRegistry::instance().variants();
  std::erase_if(all, [](const VariantInfo& v) { return !v.peer; });
  return all;
}

Collisions found_by(const std::string& peer, const Chain& chain, const Request& request = {}) {
  const auto variant = StrategyRegistry::instance().make(peer);
  Collisions found;
  variant->build(chain);
  variant->find(chain, request, found);
  return found;
}

TEST(PeersListed, AreThoseThatAUserWouldPickAndNoneIsExactByAssumption) {
  std::vector<std::string> names;
  for (const VariantInfo& peer : peers()) {
    names.push_back(peer.name);
    EXPECT_FALSE(peer.exact) << peer.name;
    EXPECT_TRUE(peer.arithmetic == "binary32" || peer.arithmetic == "binary64") << peer.name;
    if (!peer.unavailable) continue;
    EXPECT_TRUE(peer.unavailable->starts_with("catena was built without " + peer.name + " ("))
        << *peer.unavailable;
    EXPECT_THROW(StrategyRegistry::instance().make(peer.name), CapacityError);
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"Bullet", "CGAL", "Embree", "EmbreeRebuild", "FCL", "nanoflann"}));
}

class Peers : public ::testing::TestWithParam<VariantInfo> {
 protected:
  void SetUp() override {
    if (const auto& why = GetParam().unavailable) GTEST_SKIP() << *why;
  }
  const std::string& name() const { return GetParam().name; }
};

/// Searches of several threads are timed beside it, in one process.
TEST_P(Peers, LeaveTheCoresToOthers) {
  const unsigned cores = usable_cores();
  const auto variant = StrategyRegistry::instance().make(name());
  Collisions found;
  const Chain chain(std::vector<Sphere>(20, Sphere{0, 0, 0, 1}));
  variant->build(chain);
  EXPECT_EQ(usable_cores(), cores);
  const Timings built = variant->timings();
  variant->find(chain, {}, found);
  EXPECT_EQ(usable_cores(), cores);
  EXPECT_GT(built.build_ms, 0);
  EXPECT_EQ(built.find_ms, 0);
  EXPECT_EQ(variant->timings().build_ms, built.build_ms);
  EXPECT_GT(variant->timings().find_ms, 0);
}

TEST_P(Peers, AgreeWhereNoPairIsNearTouching) {
  EXPECT_TRUE(rc::check([&] {
    const auto at =
        rc::gen::map(rc::gen::inRange(-1000, 1000), [](int k) { return static_cast<float>(k) / 64; });
    const auto sphere =
        rc::gen::construct<Sphere>(at, at, at, rc::gen::map(at, [](float r) { return std::fabs(r / 8); }));
    const Chain chain(*rc::gen::container<std::vector<Sphere>>(sphere));
    const AllPairs exact = all_pairs(chain);
    RC_PRE(exact.tightest.margin > 0x1p-40);
    RC_TAG(exact.answer.pair_count > 0 ? "pairs" : "no pairs");
    RC_ASSERT(compare(chain, exact.answer, found_by(name(), chain)).right());
  }));
}

/// Embree flushes subnormal numbers to zero within its callbacks, where neither boxes nor the final test may
/// be made.
TEST_P(Peers, DigestEveryValidChainAndErrOnlyNearTies) {
  EXPECT_TRUE(rc::check([&] {
    const Chain chain(*testing::nasty_spheres());
    const Comparison c = compare(chain, find(chain), found_by(name(), chain));
    RC_ASSERT(c.well_formed());
    RC_ASSERT(c.inconsistent_counts == 0u);
    RC_ASSERT(c.worst_margin <= 0x1p-50);
  }));
}

TEST_P(Peers, FollowAMovingChain) {
  const auto tangle = [](float turn) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 1000; ++i) {
      const float t = static_cast<float>(i) * 0.7f + turn, u = static_cast<float>(i) * 0.013f * (1 + turn);
      spheres.push_back({5 * std::cos(t), 5 * std::sin(u), 5 * std::sin(t + u), 0.4f + 0.1f * std::sin(u)});
    }
    return spheres;
  };
  Chain chain(tangle(0));
  const auto variant = StrategyRegistry::instance().make(name());
  variant->build(chain);
  for (const float turn : {0.001f, 0.3f, 2.0f}) {
    chain = chain.moved(tangle(turn));
    const auto allocated = properties::Allocations::counter();
    const std::uint64_t before = allocated();
    variant->update(chain);
    // What is made anew allocates for each sphere.
    if (name() == "FCL" || name() == "Bullet") {
      EXPECT_LT(allocated() - before, 100u) << turn;
    }
    Collisions found;
    variant->find(chain, {}, found);
    const Answer exact = find(chain);
    EXPECT_GT(exact.pair_count, 500u);
    EXPECT_TRUE(compare(chain, exact, found).right()) << turn;
  }
  // Another chain is built.
  for (const std::size_t size : {700u, 1000u}) {
    std::vector<Sphere> spheres = tangle(1);
    spheres.resize(size);
    const Chain other(std::move(spheres));
    variant->update(other);
    Collisions found;
    variant->find(other, {}, found);
    EXPECT_TRUE(compare(other, find(other), found).right()) << size;
  }
  // The same spheres may lie elsewhere when they are searched, and others where they lay.
  variant->build(Chain(tangle(2)));
  const std::vector<Sphere> others(1000, Sphere{1e6f, 0, 0, 1});
  Collisions found;
  variant->find(chain, {}, found);
  EXPECT_TRUE(compare(chain, find(chain), found).right());
}

TEST_P(Peers, TakeNoSpheresOneSphereAndAFlood) {
  EXPECT_EQ(found_by(name(), Chain()).pair_count, 0u);
  EXPECT_EQ(found_by(name(), Chain({{0, 0, 0, 1}})).count.size(), 1u);
  // Two strands of a sphere each, which touch along an axis, and there alone.
  for (const Sphere& other : {Sphere{5, 3, 3, 1}, {3, 5, 3, 1}, {3, 3, 5, 1}})
    for (const Chain& two :
         {Chain({{3, 3, 3, 1}, other}, {{0, 1, 2}, {}}), Chain({other, {3, 3, 3, 1}}, {{0, 1, 2}, {}})})
      EXPECT_EQ(found_by(name(), two).pair_count, 1u);
  const Chain flood(std::vector<Sphere>(300, Sphere{1, 2, 3, 0}));
  EXPECT_EQ(found_by(name(), flood).pair_count, 300u * 299 / 2 - 299);
  EXPECT_THROW(found_by(name(), flood, {Request::Want::pairs, 5}), PairLimitExceeded);
}

/// Whatever a library takes for too far out, at whichever end of an axis, is far out for the chain alone.
TEST_P(Peers, FindWhatLiesAsFarOutAsFloatsGo) {
  for (const float radius : {0.0f, 1.0f, 0x1p127f})
    for (float Sphere::*axis : {&Sphere::x, &Sphere::y, &Sphere::z})
      for (const float end : {-std::numeric_limits<float>::max(), 0.0f, std::numeric_limits<float>::max()}) {
        Sphere far{0, 0, 0, radius};
        far.*axis = end;
        EXPECT_EQ(found_by(name(), Chain({far, far}, {{0, 1, 2}, {}})).pair_count, 1u)
            << far.x << ' ' << far.y;
      }
}

/// A library compiled with -ffast-math would make subnormal numbers zero for the whole program.
TEST_P(Peers, LeaveTheProcessorsArithmeticAsItWas) {
  found_by(name(), Chain(std::vector<Sphere>(30, Sphere{0, 0, 0, 1})));
  const volatile float least = 0x1p-149f, half = 0.5f;
  EXPECT_GT(least + least, least);
  EXPECT_EQ(least * half + least, least);
  EXPECT_GT(0x1p-126f * half, 0.0f);
}

INSTANTIATE_TEST_SUITE_P(All, Peers, ::testing::ValuesIn(peers()),
                         [](const auto& peer) { return peer.param.name; });

/// A tree by insertion is as deep as many spheres lie at one place; recursion over it would end the program.
TEST(PeerBullet, RefusesATreeTooDeepForIt) {
  const Chain coincident(std::vector<Sphere>(10'000, Sphere{0, 0, 0, 1}));
  const auto all = peers();
  const auto bullet = std::ranges::find(all, "Bullet", &VariantInfo::name);
  if (bullet->unavailable) GTEST_SKIP() << *bullet->unavailable;
  EXPECT_THROW(found_by("Bullet", coincident, {Request::Want::counts}), CapacityError);
}

}  // namespace
}  // namespace catena::reference

#include "catena/properties/small_scope/small_scope.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <tuple>

#include "catena/properties/property.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

using Key = std::vector<std::tuple<float, float, float, float>>;

std::uint64_t power(std::uint64_t base, std::uint32_t exponent) {
  std::uint64_t result = 1;
  while (exponent-- > 0) result *= base;
  return result;
}

TEST(SmallScope, VisitsOneOfEachClassAndCountsTheOthers) {
  const SmallScope scope({"square", 2, 2, 1, {0, 1}});
  EXPECT_EQ(scope.states(), 8u);
  EXPECT_EQ(scope.symmetries(), 16u);
  std::set<Key> seen;
  const auto sum = scope.for_each(3, [&](const std::vector<Sphere>& spheres) {
    Key key;
    for (const Sphere& s : spheres) key.push_back({s.x, s.y, s.z, s.radius});
    EXPECT_TRUE(seen.insert(key).second);
    std::ranges::reverse(key);
    EXPECT_TRUE(spheres.size() == 3);
    return true;
  });
  EXPECT_EQ(sum.stood_for, 512u);
  EXPECT_EQ(sum.visited, seen.size());
  EXPECT_LT(sum.visited, 60u) << "512 / 16 and some that are their own image";
}

/// Every exact host variant on every chain of the world; each chain with window 1, and as two strands (or
/// closed, or with a wider window) in turn.
class Exhaustion {
 public:
  Exhaustion() {
    for (Subject& s : Subject::available()) add(std::move(s));
    for (Subject& s : in_small_blocks(Subject::available()))
      if (s.info.name.starts_with("aGPU2") && s.info.name.ends_with("+CPU2")) add(std::move(s));
  }

  void run(const World& world, std::uint32_t n) {
    const SmallScope scope(world);
    const auto sum = scope.for_each(n, [&](const std::vector<Sphere>& spheres) {
      check(Chain(spheres));
      switch (turn_++ % 4) {
        case 0:
          check(Chain(spheres, Strands::one_closed(n)));
          break;
        case 1:
          check(Chain(spheres, {}, Exclusion::index(2)));
          break;
        case 2:
          check(Chain(spheres, {{0, n / 2, n}, {0, 1}}));
          break;
        default:
          check(Chain(spheres, {}, Exclusion::arc(1)));
      }
      return !testing::Test::HasFailure();
    });
    if (testing::Test::HasFailure()) return;
    EXPECT_EQ(sum.stood_for, power(scope.states(), n)) << world.name;
    std::cout << fmt::format("{:<24} n = {}: {:>12} chains, {:>9} up to {} symmetries\n", world.name, n,
                             sum.stood_for, sum.visited, scope.symmetries());
    stood_for += sum.stood_for;
    visited += sum.visited;
  }

  std::uint64_t stood_for = 0, visited = 0, pairs = 0;

 private:
  struct Runner {
    std::string name;
    std::unique_ptr<Variant> variant;
  };
  void add(Subject subject) {
    if (subject.exact() && !subject.info.on_device()) runners_.push_back({subject.info.name, subject.make()});
  }
  void check(const Chain& chain) {
    const Case test = Case::of(chain);
    pairs += test.exact.pair_count;
    for (const Runner& runner : runners_) {
      runner.variant->build(chain);
      runner.variant->find(chain, {}, found_);
      if (!std::ranges::is_sorted(found_.pairs)) std::ranges::sort(found_.pairs);
      ASSERT_EQ(found_.pairs, test.exact.pairs) << runner.name;
      ASSERT_EQ(found_.count, test.exact.count) << runner.name;
    }
  }

  std::vector<Runner> runners_;
  Collisions found_;
  std::uint64_t turn_ = 0;
};

TEST(SmallScope, EveryChainOfUpToFour) {
  Exhaustion all;
  for (std::uint32_t n = 1; n <= 4; ++n) {
    all.run({"2 x 2 x 2, 0 1/2 1", 2, 2, 2, {0, 0.5f, 1}}, n);
    all.run({"3 x 3, 1/2 1", 3, 3, 1, {0.5f, 1}}, n);
    all.run({"line of 6, 0 1/2 1 2", 6, 1, 1, {0, 0.5f, 1, 2}}, std::min(n, 3u));
  }
  EXPECT_GT(all.pairs, all.visited / 2);
}

struct Long {
  World world;
  std::uint32_t n;
};

const std::vector<Long>& long_worlds() {
  static const std::vector<Long> worlds{{{"2 x 2 x 2, 0 1/2 1", 2, 2, 2, {0, 0.5f, 1}}, 5},
                                        {{"2 x 2 x 2, 1/4 to 2", 2, 2, 2, {0.25f, 0.5f, 1, 2}}, 5},
                                        {{"3 x 3, 0 1/2 1", 3, 3, 1, {0, 0.5f, 1}}, 5},
                                        {{"3 x 3 x 3, 1/2", 3, 3, 3, {0.5f}}, 5},
                                        {{"3 x 3 x 3, 1/2 1", 3, 3, 3, {0.5f, 1}}, 4},
                                        {{"line of 6, 0 1/2 1 2", 6, 1, 1, {0, 0.5f, 1, 2}}, 5}};
  return worlds;
}

/// A test a world, so that they can share the cores of a machine (GTEST_TOTAL_SHARDS).
class SmallScopeLong : public testing::TestWithParam<std::size_t> {};

TEST_P(SmallScopeLong, EveryChain) {
  const Long& l = long_worlds()[GetParam()];
  Exhaustion all;
  all.run(l.world, l.n);
}

INSTANTIATE_TEST_SUITE_P(Worlds, SmallScopeLong, testing::Range(std::size_t{0}, long_worlds().size()));

TEST(SmallScope, TheLongWorldsHoldMoreThanEightyMillionChains) {
  std::uint64_t chains = 0;
  for (const Long& l : long_worlds()) chains += power(SmallScope(l.world).states(), l.n);
  EXPECT_GT(chains, 80'000'000u);
}

}  // namespace
}  // namespace catena::properties

#include "catena/core/plan/planned_search.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/allocations.h"
#include "catena/properties/failing_allocations.h"

namespace catena {
namespace {

using properties::Allocations;
using properties::FailingAllocations;

Chain row(std::uint32_t n, float spacing) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({spacing * static_cast<float>(i), 0, 0, 1});
  return Chain(std::move(spheres));
}

/// What takes longer to make than a few spheres take to search is made when it is needed.
TEST(Auto, TakesMemoryAFewTimesForAFewSpheres) {
  if (Allocations::counter() == nullptr) GTEST_SKIP();
  const Chain chain = row(4, 1);
  for (const bool warm : {false, true}) {  // at first what all searches of the program share
    const auto before = Allocations::counter()();
    const auto variant = StrategyRegistry::instance().make("auto");
    const auto made = Allocations::counter()();
    variant->build(chain);
    Collisions found;
    variant->find(chain, {}, found);
    EXPECT_EQ(found.pair_count, 2u);
    if (!warm) continue;
    EXPECT_LE(made - before, 2u) << "itself, and what sees to its floating-point environment";
    EXPECT_LE(Allocations::counter()() - made, 6u) << "who searches, and the answer";
  }
}

/// Searches that come to nothing are searches too, also the first ones.
TEST(Auto, SearchesNoSpheresAsOftenAsAsked) {
  const auto variant = StrategyRegistry::instance().make("auto");
  Collisions found;
  for (int k = 0; k < 100; ++k) {
    k % 3 == 2 ? variant->update(Chain()) : variant->build(Chain());
    variant->find(Chain(), {}, found);
    EXPECT_TRUE(!found.found && found.count.empty());
    ASSERT_EQ(variant->answered_by(), "CPU1");
  }
  variant->build(row(4, 1));
  variant->find(row(4, 1), {}, found);
  EXPECT_EQ(found.pair_count, 2u);
}

/// Of frames it is told with the build, or by the first update: it is the same from then on.
TEST(Auto, SearchesFramesWhetherOrNotTheyWereExpected) {
  const Chain chain = row(3000, 2.5f);
  const std::string before = "the frame before";
  const auto last_of = [&](bool expected, bool build_again) {
    const auto variant = StrategyRegistry::instance().make("auto(frames=measured)");
    Collisions found;
    variant->prepare({.frames_follow = expected});
    variant->build(chain);
    variant->find(chain, {}, found);
    if (build_again) variant->build(chain), variant->find(chain, {}, found);
    // Where that was the quicker by measured times, which a busy machine spoils for some frames.
    constexpr int fewest = 4, most = 64;
    for (int frame = 0; frame < fewest || (frame < most && variant->answered_by() != before); ++frame) {
      variant->update(chain);
      variant->find(chain, {}, found);
    }
    EXPECT_EQ(found.pair_count, 0u);
    return variant->answered_by();
  };
  for (const bool expected : {false, true})
    for (const bool build_again : {false, true})
      EXPECT_EQ(last_of(expected, build_again), before) << expected << build_again;
}

/// Where there is no memory to begin, it stays as it was.
TEST(Rivals, BeginOrStay) {
  if (!FailingAllocations::possible()) GTEST_SKIP();
  const Rivals::Contender first_choice{"planned", 2}, other{"planned", 1};
  Rivals rivals;
  rivals.begin(first_choice, 1);
  const std::uint64_t turn = rivals.turn();
  {
    const FailingAllocations failing(0);
    EXPECT_THROW(rivals.begin(other, 2), std::bad_alloc);
  }
  EXPECT_EQ(rivals.next(), first_choice);
  EXPECT_EQ(rivals.spheres(), 1u);
  EXPECT_EQ(rivals.turn(), turn);
}

/// Wherever memory ended in a build, the chain before is not taken for the new one.
TEST(Auto, StandsOnNoChainWhoseBuildFailed) {
  if (!FailingAllocations::possible()) GTEST_SKIP();
  const Chain apart = row(60, 3), close = row(60, 1);
  bool ended = false;
  for (std::int64_t given = 0; !ended; ++given) {
    const auto variant = StrategyRegistry::instance().make("auto");
    Collisions found;
    variant->build(apart);
    variant->find(apart, {}, found);
    variant->prepare({.frames_follow = true});  // for which it needs more
    try {
      const FailingAllocations failing(given);
      variant->build(close);
      ended = true;
    } catch (const std::bad_alloc&) {
      EXPECT_THROW(variant->find(close, {}, found), std::logic_error) << given;
    }
    variant->build(close);
    variant->find(close, {}, found);
    EXPECT_EQ(found.pair_count, 58u) << given;
  }
}

}  // namespace
}  // namespace catena

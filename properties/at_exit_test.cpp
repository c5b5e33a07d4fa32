// A search after main(): by then the statics of the library that were made since it began would be destroyed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "catena/core/plan/find.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

bool finds_all() {
  for (const std::uint32_t n : {5u, 60u, 3000u}) {  // by different variants of the plan's choice
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i % 3), 0, 0, 0.25f});
    std::uint64_t equal = 0;  // of three places, less the neighbours, which are none
    for (std::uint64_t place = 0; place < 3; ++place) {
      const std::uint64_t there = (n + 2 - place) / 3;
      equal += there * (there - 1) / 2;
    }
    if (find(Chain(std::move(spheres)), {Request::Want::counts}).pair_count != equal) return false;
  }
  return true;
}

/// auto keeps chains of its own between frames.
bool follows_a_frame() {
  const auto variant = StrategyRegistry::instance().make("auto(frames=always)");
  Chain chain;
  chain = Chain({{0, 0, 0, 1}, {4, 0, 0, 1}, {1, 0, 0, 1}});
  Collisions found;
  for (const bool first : {true, false}) {
    first ? variant->build(chain) : variant->update(chain);
    variant->find(chain, {}, found);
    if (found.pairs != std::vector<Pair>{{0, 2}}) return false;
  }
  return true;
}

void find_again() {
  if (!finds_all() || !follows_a_frame()) std::_Exit(1);
}

TEST(AtExit, ASearchNeedsNothingThatIsDestroyed) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process in which nothing was made yet
  EXPECT_EXIT(
      {
        std::atexit(find_again);
        std::exit(finds_all() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace catena

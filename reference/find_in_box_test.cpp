#include "catena/reference/find_in_box.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "catena/core/error.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/registry.h"

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

TEST(FindInBox, CountsPastTheLimitAndRefusesNarrowBoxes) {
  const Chain chain({{0, 0, 0, 1}, {4, 0, 0, 1}, {8.5f, 0, 0, 1}}, {{0, 1, 2, 3}, {0, 0, 0}});
  const PeriodicBox box{{10, 0, 0}};
  EXPECT_EQ(find_in_box(chain, box, 1).pairs, (std::vector<Pair>{{0, 2}}));
  const Answer counted = find_in_box(chain, box, 0);
  EXPECT_FALSE(counted.has_pairs);
  EXPECT_TRUE(counted.pairs.empty());
  EXPECT_EQ(counted.count, (std::vector<std::uint32_t>{1, 0, 1}));
  EXPECT_THROW(find_in_box(chain, {{3, 0, 0}}, 1), InputError);
  EXPECT_THROW(find_in_box(Chain({{1e9f, 0, 0, 1}}, {{0, 1}, {0}}), box, 1), InputError);
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

}  // namespace
}  // namespace catena::reference

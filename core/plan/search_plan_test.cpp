// Which variant is planned, by what each would take, and for how long.
#include "catena/core/plan/search_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/core/plan/test_plan.h"
#include "catena/core/plan/unusual_kind.h"

namespace catena {
namespace {

using test::chosen;
using test::machine;
using test::sixteen_cores;
using test::step;

TEST(SearchPlan, TakesWhatIsCheapestForTheNumberOfSpheres) {
  for (const std::uint32_t n : {0u, 1u, 2u, 30u}) EXPECT_EQ(chosen(n), "pairs") << n;
  for (const std::uint32_t n : {60u, 1000u, 9000u}) EXPECT_EQ(chosen(n), "tree") << n;
  for (const std::uint32_t n : {11000u, 1u << 30}) EXPECT_EQ(chosen(n), "device") << n;
}

/// The figures of each step are those of what it is about, whatever was chosen.
TEST(SearchPlan, SaysOfEachStepWhatItIsAboutTakes) {
  Machine of = machine();
  of.costs[3].cost.start_ms = 300;
  of.costs[3].started = [] { return false; };
  const MachineCost &pairs = of.costs[0].cost, &tree = of.costs[1].cost, &device = of.costs[3].cost;
  for (const std::uint32_t n : {5u, 200u, 11000u}) {
    SearchHistory history;
    history.add(n, 1, 7);
    const Plan plan = SearchPlan(n, {}, of, {}, {}, history).steps();
    EXPECT_EQ(step(plan, "hierarchy").left_out, n == 5) << n;
    EXPECT_EQ(step(plan, "hierarchy").estimate_ms, tree.ms(n)) << n;
    EXPECT_EQ(
        step(plan, "hierarchy").reason,
        fmt::format("{} spheres: tree about {:.3g} ms, pairs about {:.3g} ms", n, tree.ms(n), pairs.ms(n)));
    EXPECT_EQ(step(plan, "device").estimate_ms, device.ms(n)) << n;
    EXPECT_TRUE(step(plan, "device").left_out) << n;
    EXPECT_EQ(
        step(plan, "device").reason,
        fmt::format("device about {:.3g} ms, tree about {:.3g} ms{}; not looked for", device.ms(n),
                    tree.ms(n), n == 11000 ? "; to start it about 300 ms, of which 7 were lost so far" : ""));
  }
  of.costs[3].started = [] { return true; };
  const Decision taken = step(SearchPlan(11000, {}, of, {}).steps(), "device");
  EXPECT_FALSE(taken.left_out);
  EXPECT_EQ(taken.reason,
            fmt::format("device about {:.3g} ms, tree about {:.3g} ms", device.ms(11000), tree.ms(11000)));
}

/// A few spheres are compared all with all, whatever their kind, and threads that must be had are the usual
/// variant's.
TEST(SearchPlan, AsksForTheKindOnlyWhereItMayTakeThePlaceOfTheTree) {
  const Machine of = machine();
  const Chain few = open_input("path1:n=30").animation->frame(0),
              more = open_input("yarn:n=700").animation->frame(0);
  const auto plan = [&](const Chain& chain, const std::vector<std::string>& keep) {
    return SearchPlan(chain.size(), {}, of, Omissions::without(keep), chain.view());
  };
  const SearchPlan of_few = plan(few, {});
  EXPECT_EQ(of_few.variant(), "pairs");
  EXPECT_TRUE(of_few.holds_for(few.size(), {}, few.view()));
  ASSERT_NE(UnusualKind::of(more.view()), nullptr);
  EXPECT_NE(plan(more, {}).variant(), "tree");
  EXPECT_EQ(plan(more, {"threads"}).variant(), "tree");
}

/// The figure of the usual variant is none of another that an unusual kind of chain puts in its place.
TEST(SearchPlan, EstimatesTheVariantThatItNamesOrNone) {
  const Machine of = sixteen_cores();
  std::vector<Sphere> spheres;
  for (int i = 0; i < 2000; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.4f});
  const Chain chain(std::move(spheres));
  const SearchPlan unusual(chain.size(), {}, of, {}, chain.view());
  const SearchPlan usual(chain.size(), {}, of, {});
  ASSERT_EQ(unusual.variant(), "ChainTree");
  ASSERT_EQ(usual.variant(), "Hybrid");
  EXPECT_EQ(step(unusual.steps(), "choice of variant").estimate_ms, std::nullopt);
  EXPECT_EQ(step(usual.steps(), "choice of variant").estimate_ms, usual.estimate_ms());
  EXPECT_NE(step(unusual.steps(), "hierarchy").reason.find("Hybrid about"), std::string::npos);
}

/// A few spheres in no order are sorted once for several frames.
TEST(SearchPlan, OfFramesTakesWhatKeepsAnOrder) {
  std::mt19937 dice(5);
  std::uniform_real_distribution<float> side(0, 30);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 1000; ++i) spheres.push_back({side(dice), side(dice), side(dice), 0.4f});
  const Chain chain(std::move(spheres));
  const auto variant_of = [&](bool frames_follow) {
    return SearchPlan(chain.size(), {.frames_follow = frames_follow}, Machine::here(), {}, chain.view())
        .variant();
  };
  EXPECT_EQ(variant_of(false), "Grid");
  EXPECT_EQ(variant_of(true), "SphereTree");
}

TEST(SearchPlan, HoldsForChainsThatWouldBePlannedAlike) {
  const Machine of = Machine::built_in();
  const auto without_spheres = [](const char* input) {
    ChainView chain{};
    chain.size = 1000, chain.extent = open_input(input).animation->frame(0).view().extent;
    return chain;
  };
  const ChainView crowded = without_spheres("yarn:n=1000"), sparse = without_spheres("path1:n=1000"),
                  wide = without_spheres("cluster:n=1000");
  for (const ChainView& first : {crowded, sparse, wide, ChainView{}}) {
    const SearchPlan plan(1000, {}, of, {}, first);
    for (const ChainView& other : {crowded, sparse, wide, ChainView{}})
      EXPECT_EQ(plan.holds_for(1000, {}, other),
                plan.variant() == SearchPlan(1000, {}, of, {}, other).variant());
    EXPECT_FALSE(plan.holds_for(1001, {}, first));
    EXPECT_FALSE(plan.holds_for(1000, {Request::Want::any}, first));
    EXPECT_FALSE(plan.holds_for(1000, {.frames_follow = true}, first));
  }
}

}  // namespace
}  // namespace catena

// How many threads a plan takes, and what it learns of that from searches.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/plan/test_plan.h"

namespace catena {
namespace {

using test::sixteen_cores;
using test::step;

TEST(SearchPlan, TakesThreadsWhereTheyPayAndNoMoreThanThat) {
  const Machine of = sixteen_cores();
  const auto threads = [&](std::uint32_t n, const std::vector<std::string>& keep = {}) {
    return SearchPlan(n, {}, of, Omissions::without(keep)).threads();
  };
  EXPECT_EQ(threads(100), 1u);
  EXPECT_EQ(threads(1000), 1u) << "10 us of search, and 40 us for a team";
  EXPECT_EQ(threads(100, {"threads"}), 16u);
  unsigned before = 1;
  int ruled_out = 0;
  for (std::uint32_t n = 1000; n < 1u << 30; n += n / 2) {
    const unsigned now = threads(n);
    // Where two would take less and are not taken all the same, it says by which rule.
    const MachineCost& cost = of.costs[0].cost;
    const Decision further = step(SearchPlan(n, {}, of, {}).steps(), "further threads");
    const bool cheaper_all_the_same = now == 1 && cost.ms(n, 2) < cost.ms(n);
    EXPECT_EQ(further.reason.find("; they save less than 0.08 ms, twice what a team takes") !=
                      further.reason.npos ||
                  further.reason.find("; that saves less than a tenth") != further.reason.npos,
              cheaper_all_the_same)
        << further.reason;
    ruled_out += cheaper_all_the_same;
    EXPECT_GE(now, before) << n;
    EXPECT_LE(now, 16u);
    if (now > 1) {
      const double alone = of.costs[0].cost.ms(n), team = of.costs[0].cost.team_us * 1e-3;
      EXPECT_LT(SearchPlan(n, {}, of, {}).estimate_ms(), alone) << n;
      EXPECT_GT((alone - 1e-3) / 2 * of.costs[0].cost.serial, team) << n << ": where half is to be done, too";
    }
    before = now;
  }
  EXPECT_EQ(before, 16u);
  EXPECT_GT(ruled_out, 0);
  EXPECT_EQ(SearchPlan(1u << 24, {}, of, {}).variant_with_threads(), "Hybrid(threads=16)");
  const Plan plan = SearchPlan(1u << 24, {}, of, {}).steps();
  EXPECT_FALSE(step(plan, "further threads").left_out);
  const MachineCost& cost = of.costs[0].cost;
  EXPECT_EQ(step(plan, "further threads").reason,
            fmt::format("Hybrid with 16 threads about {:.3g} ms, Hybrid about {:.3g} ms; 16 cores",
                        cost.ms(1u << 24, 16), cost.ms(1u << 24)));
  EXPECT_NE(step(plan, "choice of variant").reason.find("Hybrid(threads=16)"), std::string::npos);
  EXPECT_TRUE(step(SearchPlan(100, {}, of, {}).steps(), "further threads").left_out);
  Machine one = of;
  one.cores = 1;
  EXPECT_EQ(SearchPlan(1u << 24, {}, one, {}).threads(), 1u);
}

/// Spheres that touch those beside them in a block, in no order: each takes a host several times as long as
/// in a tube.
TEST(SearchPlan, TakesThreadsSoonerWhereMuchIsNear) {
  Machine of = sixteen_cores();
  const auto plan = [&](const ChainView& chain) { return SearchPlan(chain.size, {}, of, {}, chain); };
  // A lattice in no order, and in rows that go on elsewhere.
  const auto crowded = [](std::uint32_t row) {
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < 8000; ++k) {
      const std::uint32_t at = k / row * 3001 % (8000 / row) * row + k % row;
      spheres.push_back({static_cast<float>(at % 20), static_cast<float>(at / 20 % 20),
                         static_cast<float>(at / 400), 0.5f});
    }
    return Chain(std::move(spheres));
  };
  for (const auto& [row, variant] : {std::pair(1u, "Hybrid"), {20u, "Grid"}}) {
    const Chain chain = crowded(row);
    EXPECT_EQ(plan(chain.view()).variant(), variant) << row;
    EXPECT_GT(plan(chain.view()).threads(), 1u) << row;
    EXPECT_TRUE(plan(chain.view()).holds_for(8000, {}, chain.view())) << row;
    EXPECT_GT(plan(chain.view()).estimate_ms(), SearchPlan(8000, {}, of, {}).estimate_ms()) << row;
  }
  EXPECT_EQ(SearchPlan(8000, {}, of, {}).threads(), 1u);
  // What was measured counts more than what such chains take.
  SearchHistory history;
  for (int k = 0; k < 2; ++k) history.add(8000, 2, 0);
  const Chain chain = crowded(1);
  const ChainView view = chain.view();
  EXPECT_EQ(SearchPlan(8000, {}, of, {}, view, history).estimate_ms(),
            SearchPlan(8000, {}, of, {}, {}, history).estimate_ms());
  // Where that is so much that all pairs take less, it is no matter in which order they lie.
  of.costs.push_back({"pairs", {{.sphere_pair_ns = 0.0047}}, false, true});
  EXPECT_EQ(SearchPlan(8000, {}, of, {}).variant(), "Hybrid");
  EXPECT_EQ(plan(view).variant(), "pairs");
  EXPECT_TRUE(plan(view).holds_for(8000, {}, view));
}

TEST(SearchPlan, LearnsWhatASphereTakesFromTwoSearches) {
  const Machine of = sixteen_cores();
  constexpr std::uint32_t n = 8000;
  const auto plan = [&](const SearchHistory& history) { return SearchPlan(n, {}, of, {}, {}, history); };
  SearchHistory history;
  ASSERT_EQ(plan(history).threads(), 1u);
  plan(history).tell(1, history);
  EXPECT_EQ(plan(history).threads(), 1u) << "a first search takes longer than those after it";
  EXPECT_TRUE(plan({}).holds_for(n, {}, {}, history));
  plan(history).tell(0.9, history);
  EXPECT_FALSE(plan({}).holds_for(n, {}, {}, history));
  const SearchPlan crowded = plan(history);
  EXPECT_GT(crowded.threads(), 1u);
  EXPECT_EQ(plan(history).estimate_ms(), crowded.estimate_ms());
  EXPECT_EQ(SearchPlan(n + 1, {}, of, {}, {}, history).threads(), 1u) << "of other spheres";
  for (int k = 0; k < 3; ++k) {  // it takes what it was thought to, give or take a fifth
    crowded.tell(crowded.estimate_ms() * (1 + (k - 1) / 5.), history);
    EXPECT_TRUE(crowded.holds_for(n, {}, {}, history));
    EXPECT_EQ(plan(history).threads(), crowded.threads());
  }
  crowded.tell(100, history);
  EXPECT_TRUE(crowded.holds_for(n, {}, {}, history)) << "one that was disturbed";
  for (int k = 0; k < 2; ++k) crowded.tell(0.06, history);
  EXPECT_FALSE(crowded.holds_for(n, {}, {}, history));
  EXPECT_EQ(plan(history).threads(), 1u);
  SearchHistory few;
  for (int k = 0; k < 2; ++k) SearchPlan(1000, {}, of, {}).tell(50, few);
  EXPECT_EQ(few.times(1000), 0);
}

TEST(SearchPlan, HasNoFurtherThreadsOnOneCore) {
  Machine of = sixteen_cores();
  of.cores = 1;
  const Decision threads = step(SearchPlan(1u << 20, {}, of, {}).steps(), "further threads");
  EXPECT_TRUE(threads.left_out);
  EXPECT_EQ(threads.reason, "there is one core");
}

}  // namespace
}  // namespace catena

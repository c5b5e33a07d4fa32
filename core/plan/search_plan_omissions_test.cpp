// What a plan leaves out, what it says of that, and that it does what may not be left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/plan/test_plan.h"

namespace catena {
namespace {

using test::chosen;
using test::machine;
using test::step;
using Want = Request::Want;

TEST(SearchPlan, SaysWhatItLeavesOutAndTheFigureThatDecided) {
  const Machine of = machine();
  const Plan plan = SearchPlan(20, {Want::counts}, of, {}).steps();
  EXPECT_TRUE(step(plan, "hierarchy").left_out);
  EXPECT_NE(step(plan, "hierarchy").reason.find("20 spheres"), std::string::npos);
  EXPECT_TRUE(step(plan, "pair list").left_out);
  EXPECT_TRUE(step(plan, "device").left_out);
  const Plan full = SearchPlan(20, {Want::counts}, of, Omissions::without(omission_names())).steps();
  for (const char* name : {"hierarchy", "pair list", "device"})
    EXPECT_FALSE(step(full, name).left_out) << name;
  EXPECT_NE(step(full, "pair list").reason.find("--no-omit pair-list"), std::string::npos);
}

/// Of yes or no it says which steps that spares, and of which none may be spared.
TEST(SearchPlan, SaysWhatYesOrNoSpares) {
  const Machine of = machine();
  const std::string after_hit = info_of(Omission::after_hit).step,
                    places = info_of(Omission::other_places).step;
  const auto steps = [&](std::uint32_t n, const std::vector<std::string>& keep) {
    return SearchPlan(n, {Want::any}, of, Omissions::without(keep)).steps();
  };
  const Plan spared = steps(8192, {}), kept = steps(8192, {"after-hit"});
  EXPECT_TRUE(step(spared, after_hit).left_out);
  EXPECT_EQ(step(spared, "pair list").reason, "only yes or no is asked for");
  EXPECT_TRUE(step(spared, places).left_out);
  EXPECT_EQ(step(spared, places).reason, "a look at every 1024th sphere first, 8 of 8192");
  EXPECT_FALSE(step(kept, after_hit).left_out);
  EXPECT_TRUE(step(kept, after_hit).reason.ends_with("; --no-omit after-hit"));
  EXPECT_FALSE(step(kept, places).left_out);
  EXPECT_EQ(step(kept, places).reason, "it does not tell all, and all are searched for");
  EXPECT_EQ(step(steps(300000, {}), places).reason,
            "a look at every 1024th sphere first, 292 of 300000, then at one of 256 parts");
  EXPECT_EQ(step(steps(100, {}), places).reason, "100 spheres: a look pays from 8192 on");
  EXPECT_THROW(step(SearchPlan(8192, {}, of, {}).steps(), places), std::logic_error);
}

TEST(SearchPlan, LooksAtLikelyPlacesWhereThatMayBeLeftOut) {
  const Machine of = machine();
  constexpr std::uint32_t n = CoarseLook::least;
  const auto looks = [&](std::uint32_t spheres, Want want, const std::vector<std::string>& keep) {
    return SearchPlan(spheres, {want}, of, Omissions::without(keep)).look_first();
  };
  EXPECT_TRUE(looks(n, Want::any, {}));
  EXPECT_FALSE(looks(n - 1, Want::any, {}));
  EXPECT_FALSE(looks(n, Want::counts, {}));
  EXPECT_FALSE(looks(n, Want::any, {"other-places"}));
  EXPECT_FALSE(looks(n, Want::any, {"after-hit"}));
}

TEST(SearchPlan, DoesWhatMayNotBeLeftOut) {
  EXPECT_EQ(chosen(5, {"hierarchy"}), "tree");
  EXPECT_EQ(chosen(5, {"device"}), "device");
  EXPECT_EQ(chosen(5, {"device", "hierarchy"}), "device");
  Machine without = machine();
  without.costs.pop_back();
  EXPECT_EQ(chosen(1u << 20, {"device"}, without), "tree");
  EXPECT_THROW(chosen(5, {}, Machine{}), CapacityError);
}

/// What a strategy leaves out by itself it is told to do.
TEST(SearchPlan, TellsAStrategyWhatMayNotBeLeftOut) {
  Machine of = machine();
  of.costs = {{"Hybrid", {{.fixed_us = 1, .sphere_ns = 10}}}};
  const auto named = [&](const std::vector<std::string>& keep) {
    return SearchPlan(5000, {}, of, Omissions::without(keep)).variant_with_threads();
  };
  EXPECT_EQ(named({}), "Hybrid");
  EXPECT_EQ(named({"straight"}), "Hybrid(rows=search)");
  EXPECT_EQ(named({"exact"}), "Hybrid(exact=all)");
  EXPECT_EQ(named({"radii"}), "Hybrid(radii=each)");
  EXPECT_EQ(named({"strand-table"}), "Hybrid(strands=read)");
  EXPECT_EQ(named({"range-checks", "upload"}), "Hybrid") << "which has none";
  EXPECT_EQ(named({"straight", "exact", "radii", "strand-table"}),
            "Hybrid(rows=search,exact=all,radii=each,strands=read)");
  of.costs[0].variant = "CPU1";  // which knows none of the first three
  EXPECT_EQ(named({"straight", "exact", "radii"}), "CPU1");
  EXPECT_EQ(named({"strand-table", "range-checks", "upload"}), "CPU1(strands=read,range=checked)");
}

TEST(SearchPlan, EveryOmissionStatesItsObligation) {
  EXPECT_THROW(Omissions::without(std::vector<std::string>{"nonsense"}), std::logic_error);
  std::vector<std::string> names = omission_names();
  std::ranges::sort(names);
  EXPECT_TRUE(std::ranges::adjacent_find(names) == names.end());
  for (const OmissionInfo& o : all_omissions()) {
    EXPECT_FALSE(o.obligation.empty()) << o.name;
    EXPECT_EQ(&info_of(o.omission), &o);
    EXPECT_FALSE(Omissions::without(std::vector{o.name}).may(o.omission)) << o.name;
    EXPECT_TRUE(Omissions().may(o.omission)) << o.name;
  }
}

}  // namespace
}  // namespace catena

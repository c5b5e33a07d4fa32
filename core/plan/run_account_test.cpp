#include "catena/core/plan/run_account.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/plan/omissions.h"
#include "catena/core/plan/test_plan.h"

namespace catena {
namespace {

using test::step;

Plan planned(bool tree) {
  return {{"choice of variant", false, "a test"},
          {info_of(Omission::hierarchy).step, !tree, ""},
          {info_of(Omission::pair_list).step, true, ""}};
}

std::vector<std::string> names(const Plan& plan) {
  std::vector<std::string> all;
  for (const Decision& decision : plan) all.push_back(decision.step);
  return all;
}

TEST(RunAccount, SaysWhatEachStepTookAndAddsWhatWasNoChoice) {
  Plan plan = planned(true);
  RunAccount run;
  run.spheres = 20, run.took = {2, 3, 4, 0}, run.planning_ms = 0.09, run.unlisted = 7;
  run.searcher = {
      "tree", false, {1.5, 2.5, 3.5, 5}, {{"node, node", 11}, {"never", 0}, {"sphere, sphere", 1}}};
  tell_run(run, plan);  // as a whole, and of who searched
  EXPECT_EQ(names(plan),
            (std::vector<std::string>{"choice of variant", "planning", "hierarchy", "pair list", "build",
                                      "search", "moves between memories", "start of the device"}));
  for (const char* added : {"planning", "build", "search", "moves between memories", "start of the device"})
    EXPECT_FALSE(step(plan, added).left_out) << added;
  EXPECT_EQ(plan.front().actual_ms, 9);
  EXPECT_EQ(step(plan, "planning").actual_ms, 0.09);
  EXPECT_EQ(step(plan, "planning").reason, "1 % of build and search");
  EXPECT_EQ(step(plan, "hierarchy").actual_ms, 1.5);
  EXPECT_EQ(step(plan, "pair list").removed, "7 pairs");
  EXPECT_EQ(step(plan, "build").actual_ms, 1.5);
  EXPECT_EQ(step(plan, "search").actual_ms, 2.5);
  EXPECT_EQ(step(plan, "search").reason,
            "of 190 pairs of spheres: node, node 11 times; sphere, sphere 1 time");
  EXPECT_EQ(step(plan, "moves between memories").actual_ms, 3.5);
  EXPECT_EQ(step(plan, "start of the device").actual_ms, 5);
}

TEST(RunAccount, SaysWhatPlanningTakesOnceThreadsAreStarted) {
  Plan plan = planned(true);
  RunAccount run;
  run.took = {2, 3}, run.planning_ms = 8, run.planning_again_ms = 0.01;
  tell_run(run, plan);
  EXPECT_EQ(step(plan, "planning").actual_ms, 8);
  EXPECT_EQ(step(plan, "planning").reason,
            "once more 0.01 ms, 0.2 % of build and search: a first time in a program starts its threads");
  plan = planned(true);
  run.planning_again_ms = 60;
  tell_run(run, plan);
  EXPECT_TRUE(step(plan, "planning").reason.starts_with("once more 60 ms, 1200 % of build"));
  plan = planned(true);
  run.took = {};
  run.planning_again_ms.reset();
  tell_run(run, plan);
  EXPECT_EQ(step(plan, "planning").reason, "of a search of nothing");
}

/// What was done in the place of a hierarchy is all of it; a list that was kept has nothing removed.
TEST(RunAccount, SaysWhatAllPairsTook) {
  Plan plan = planned(false);
  plan.back().left_out = false;
  RunAccount run;
  run.spheres = 1, run.took = {0.5, 3}, run.unlisted = 7;
  run.searcher = {"pairs", true, {0.5, 3}, {}};
  tell_run(run, plan);
  EXPECT_EQ(step(plan, "hierarchy").actual_ms, 3.5);
  EXPECT_EQ(step(plan, "search").reason, "of 0 pairs of spheres: each");
  EXPECT_EQ(step(plan, "pair list").removed, "");
  EXPECT_EQ(names(plan),
            (std::vector<std::string>{"choice of variant", "hierarchy", "pair list", "build", "search"}));
}

/// A look, or the frame before, answers: nothing was built, and no time is told of it.
TEST(RunAccount, SaysNothingOfABuildThatWasNotMade) {
  Plan plan = planned(false);
  plan.push_back({info_of(Omission::other_places).step, true, ""});
  RunAccount run;
  run.took = {1, 2}, run.look_ms = 0.25;
  tell_run(run, plan);
  EXPECT_EQ(plan.size(), 4u);
  EXPECT_EQ(plan.back().actual_ms, 0.25);
  EXPECT_EQ(step(plan, "hierarchy").actual_ms, std::nullopt);
  plan.back() = {info_of(Omission::other_places).step, false, "it found nothing"};
  tell_run(run, plan);
  EXPECT_EQ(plan.back().actual_ms, std::nullopt) << "it was not spared";
  Plan none;
  run.planning_ms = 1;
  tell_run(run, none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace catena

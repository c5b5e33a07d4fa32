#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/frames/frame_search.h"

namespace catena {
namespace {

TEST(ListPolicy, TakesAThickerSkinWhereARebuildIsDearer) {
  ListPolicy cheap, dear;
  for (ListPolicy* policy : {&cheap, &dear}) {
    for (int k = 0; k < 3; ++k) policy->searched(20);
    EXPECT_LE(policy->skin_for(0.01, 1), 0.5) << "a first one is thin";
    for (int k = 0; k < 9; ++k) {
      policy->rebuilt(policy == &cheap ? 5 : 100, 0.01, 0.5, 1);
      policy->used(4);
      for (int prunes = 0; prunes < 3; ++prunes) policy->pruned(10, 3e5, 1e5);
    }
  }
  EXPECT_LT(cheap.skin_for(0.01, 1), dear.skin_for(0.01, 1));
  dear.rebuilt(100, 0.01, 0.1, 1);
  EXPECT_LE(dear.skin_for(0.01, 1), 0.2) << "twice the last one";
  EXPECT_LE(dear.skin_for(0.01, 0.05), 0.05) << "the radius";
  EXPECT_TRUE(dear.pays(0.3, 0.01, 1));
  for (int k = 0; k < 21; ++k) dear.used(40);
  EXPECT_FALSE(dear.pays(0.3, 0.01, 1)) << "where it costs more than a full search";
}

/// What took very long, as something else ran, tells no more than that it was long, however long; what
/// touches memory for the first time tells nothing.
TEST(ListPolicy, LearnsTheSameOfAllThatTookVeryLong) {
  ListPolicy policies[2];
  for (ListPolicy& policy : policies) {
    const double spike = &policy == policies ? 1e3 : 1e6;
    for (int k = 0; k < 3; ++k) policy.searched(20);
    policy.searched(spike);
    policy.rebuilt(spike, 0.01, 0.9, 1);
    policy.pruned(spike - 1e3, 3e5, 1e5);
    for (int k = 0; k < 3; ++k) policy.used(spike);
    EXPECT_LE(policy.skin_for(1, 1), 1) << "no more than the radius, after a thick one";
  }
  EXPECT_EQ(policies[0].full_ms(), policies[1].full_ms());
  EXPECT_EQ(policies[0].mean_ms(0.3, 0.01, 1), policies[1].mean_ms(0.3, 0.01, 1));
}

/// Of a list that is made or pruned for more frames each pays less.
TEST(ListPolicy, AFrameCostsLessWhereListsLiveLonger) {
  ListPolicy straight, to_and_fro, seldom_pruned;
  for (ListPolicy* policy : {&straight, &to_and_fro, &seldom_pruned}) {
    for (int k = 0; k < 3; ++k) policy->searched(20);
    for (int lists = 0; lists < 3; ++lists) {
      policy->rebuilt(30, 0.01, 0.2, 1);
      for (int prunes = 0; prunes < 3; ++prunes) {
        for (int k = 0; k < (policy == &straight ? 5 : 20); ++k) policy->used(5);
        policy->pruned(15, 3e5, 1e5);
      }
      if (policy != &seldom_pruned) policy->ended();
    }
  }
  EXPECT_LT(seldom_pruned.mean_ms(0.1, 0.01, 1), straight.mean_ms(0.1, 0.01, 1));
  EXPECT_LT(to_and_fro.mean_ms(0.1, 0.01, 1), seldom_pruned.mean_ms(0.1, 0.01, 1));
}

/// A first list may cost a little more than a full search, so that it is learnt what lists take; a later one
/// less.
TEST(ListPolicy, AsksMoreOfListsOnceOneWasMade) {
  ListPolicy policy;
  for (int k = 0; k < 3; ++k) policy.searched(20);
  for (const bool made : {false, true}) {
    bool dearer_pays = false;
    for (double move = 1e-3; move < 1; move *= 1.05)
      dearer_pays |= policy.pays(0.1, move, 1) && policy.mean_ms(0.1, move, 1) > policy.full_ms();
    EXPECT_EQ(dearer_pays, !made);
    policy.rebuilt(30, 0.01, 0.1, 1);
  }
}

/// What pruning takes is laid to the skin where it finds few of the pairs, so that a thicker one costs more;
/// and one list that took long to make tells less than many.
TEST(ListPolicy, LearnsWhatTheSkinCostsAndWhatIsUsual) {
  const auto cost = [](double skin, double found, double last_ms, double usual_ms) {
    ListPolicy policy;
    for (int k = 0; k < 3; ++k) policy.searched(20);
    for (int k = 0; k < 8; ++k) {
      policy.rebuilt(k == 7 ? last_ms : usual_ms, 0.01, 0.2, 1);
      for (int use = 0; use < 4; ++use) policy.used(4);
      for (int prunes = 0; prunes < 3; ++prunes) policy.pruned(10, 1e5, found);
    }
    return policy.mean_ms(skin, 0.01, 1);
  };
  EXPECT_GT(cost(0.4, 1e3, 30, 30) - cost(0.2, 1e3, 30, 30), cost(0.4, 9e4, 30, 30) - cost(0.2, 9e4, 30, 30));
  EXPECT_LT(cost(0.2, 1e3, 30, 30), cost(0.2, 1e3, 60, 30));
  EXPECT_LT(cost(0.2, 1e3, 60, 30), cost(0.2, 1e3, 60, 60));
}

TEST(ListPolicy, HoldsAFullSearchForNoDearerThanOneOfThickerSpheres) {
  ListPolicy policy;
  for (int k = 0; k < 3; ++k) policy.searched(20);
  policy.searched_thicker(30);
  EXPECT_EQ(policy.full_ms(), 20);
  policy.searched_thicker(12);
  EXPECT_EQ(policy.full_ms(), 12);
}

TEST(ListPolicy, MakesNoListWhereLookingAtEachSphereTakesAsLongAsASearch) {
  ListPolicy policy;
  for (int k = 0; k < 3; ++k) policy.searched(0.1);
  policy.expect(1000);
  EXPECT_TRUE(policy.pays(0.1, 1e-3, 1));
  policy.expect(30000);
  EXPECT_FALSE(policy.pays(0.1, 1e-3, 1));
}

}  // namespace
}  // namespace catena

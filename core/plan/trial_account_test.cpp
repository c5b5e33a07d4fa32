#include "catena/core/plan/trial_account.h"

#include <gtest/gtest.h>

namespace catena {
namespace {

/// Whatever is lost at each try, n searches take no more than n usual ones, a hundredth and a few.
TEST(TrialAccount, LosesAShareOfAllSearchesAtMost) {
  for (const double loss : {0.1, 1.0, 7.0}) {
    TrialAccount account;
    double ms = 0;
    const int searches = 2000;
    for (int k = 0; k < searches; ++k) {
      account.search();
      const double took = account.may_try() ? 1 + loss : 1;
      if (took > 1) account.used(took, 1, 8);
      ms += took;
    }
    EXPECT_LT(ms, 1.01 * searches + 2 + loss) << loss;
    EXPECT_GT(ms, searches + 10) << "it is tried again";
  }
}

/// A search that took very long, as something else ran, says no more than the most that it may lose.
TEST(TrialAccount, LosesNoMoreByOneSearchThanItIsTold) {
  TrialAccount account;
  account.used(1e9, 1, 2);
  EXPECT_FALSE(account.may_try());
  for (int k = 0; k < 150; ++k) account.search();
  EXPECT_TRUE(account.may_try());
}

/// However long nothing was lost, no more than sixteen searches may be at once; and what has no usual time
/// says nothing.
TEST(TrialAccount, SavesNoMoreThanSixteenSearches) {
  TrialAccount account;
  for (int k = 0; k < 10000; ++k) account.search();
  for (const double all : {8, 16}) {
    account.used(9, 1, 8);
    EXPECT_TRUE(account.may_try()) << all;
  }
  account.used(9, 0, 8);
  EXPECT_TRUE(account.may_try());
  account.used(9, 1, 8);
  EXPECT_FALSE(account.may_try());
}

}  // namespace
}  // namespace catena

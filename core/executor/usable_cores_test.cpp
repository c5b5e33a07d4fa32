#include "catena/core/executor/usable_cores.h"

#include <gtest/gtest.h>

#include "catena/core/executor/team.h"

namespace catena {
namespace {

TEST(UsableCores, AreNoMoreThanTheLimitWhileItLives) {
  const unsigned all = usable_cores();
  ASSERT_GE(all, 1u);
  {
    const CoreLimit one(1);
    EXPECT_EQ(usable_cores(), 1u);
    EXPECT_EQ(Team(Parameters("test", {Team::threads_parameter()}, "threads=0")).size(), 1u);
    EXPECT_EQ(Team(Parameters("test", {Team::threads_parameter()}, "threads=9")).size(), 1u);
  }
  EXPECT_EQ(usable_cores(), all);
  const CoreLimit none(0);
  EXPECT_EQ(usable_cores(), 1u);
}

TEST(UsableCores, AreNoMoreThanThereAre) {
  const unsigned all = usable_cores();
  const CoreLimit many(all + 5);
  EXPECT_EQ(usable_cores(), all);
}

}  // namespace
}  // namespace catena

#include "catena/core/commands/alone.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "catena/core/error.h"

namespace catena {
namespace {

TEST(Alone, IsWhoeverWasNotStartedWithOthers) {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    EXPECT_NO_THROW(require_alone()) << name;
    for (const char* one : {"1", "", "x"}) {
      setenv(name, one, 1);
      EXPECT_NO_THROW(require_alone()) << name << ' ' << one;
    }
    setenv(name, "2", 1);
    EXPECT_THROW(require_alone(), InputError) << name;
    unsetenv(name);
  }
}

}  // namespace
}  // namespace catena

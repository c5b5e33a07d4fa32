#include "catena/core/commands/alone.h"

#include <fmt/format.h>

#include <cstdlib>

#include "catena/core/error.h"

namespace catena {

void require_alone() {
  // Of Open MPI, of PMI-2 as in MPICH, and of a step of Slurm.
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* told = std::getenv(name); told != nullptr && std::atoi(told) > 1)
      throw InputError(
          fmt::format("one of {} processes that were started together ({}), of which this build knows "
                      "nothing; build catena with "
                      "CATENA_MPI=ON, or start one process",
                      told, name));
}

}  // namespace catena

#include "catena/core/ranks/mpi/mpi_launcher.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/guarded_main.h"
#include "catena/core/error.h"
#include "catena/core/executor/usable_cores.h"
#include "catena/core/ranks/core_share.h"
#include "catena/core/ranks/mpi/mpi_communicator.h"

namespace catena::ranks {
namespace {

std::unique_ptr<MpiCommunicator> communicator;

/// What this process prints goes nowhere from here on: one voice is enough. Returns what was standard error.
int fall_silent() {
  const int standard_error = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  return standard_error;
}

Cores usable_by_this_process() {
  Cores cores;
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return cores;
  for (std::size_t core = 0; core < cores.size(); ++core) cores[core] = CPU_ISSET(core, &set) != 0;
  return cores;
}

/// How many cores this rank may keep busy, as others of the same machine have theirs.
unsigned own_cores() {
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int size = 1, rank = 0;
  MPI_Comm_size(machine, &size);
  MPI_Comm_rank(machine, &rank);
  const Cores own = usable_by_this_process();
  std::vector<Cores> all(static_cast<std::size_t>(size));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, machine);
  MPI_Comm_free(&machine);
  return core_share(all, static_cast<std::size_t>(rank));
}

/// MPI, and the communicator, while this lives.
class Session {
 public:
  Session() {
    // oneTBB's threads search beside the one that calls MPI.
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads_);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    communicator =
        std::make_unique<MpiCommunicator>(MPI_COMM_WORLD, rank == 0 ? STDERR_FILENO : fall_silent());
  }
  ~Session() {
    std::fflush(nullptr);
    communicator.reset();
    MPI_Finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void require_threads() const {
    if (threads_ < MPI_THREAD_FUNNELED)
      throw CapacityError("this MPI allows no threads (MPI_THREAD_FUNNELED); run catena by another one");
  }

 private:
  int threads_ = MPI_THREAD_SINGLE;
};

/// What a rank refuses before it works with others, such as an option, they would wait for in vain; so all of
/// the body is done together. What rank 0 met itself it says as one process does: mostly all ranks met it.
int run_together(const std::function<int()>& body) {
  int code = 0;
  std::exception_ptr own;
  try {
    together(*communicator, [&] {
      try {
        code = body();
      } catch (const RankFailed&) {
        throw;
      } catch (...) {
        own = std::current_exception();
        throw;
      }
    });
  } catch (const RankFailed&) {
    if (own && communicator->rank() == 0) std::rethrow_exception(own);
    throw;
  }
  return code;
}

class MpiLauncher final : public Launcher {
 public:
  /// By what Open MPI's mpirun, and srun with PMIx or PMI-2, tell their processes; MPI_Init takes too long to
  /// be tried.
  bool launched() const override {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (std::getenv(name) != nullptr) return true;
    return false;
  }

  int run(const std::function<int()>& body) override {
    const Session session;
    const CoreLimit limit(own_cores());
    // Before this process may leave: mpirun ends the others when one left with an exit code.
    return guarded_main("catena", [&] {
      session.require_threads();
      return run_together(body);
    });
  }
};

const bool registered = [] {
  CommandRegistry::instance().set_launcher(std::make_unique<MpiLauncher>());
  return true;
}();

}  // namespace

Communicator& world() {
  if (!communicator) throw std::logic_error("no launcher runs this command");
  return *communicator;
}

}  // namespace catena::ranks

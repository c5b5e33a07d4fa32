#include "catena/core/executor/startable_threads.h"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/executor/usable_cores.h"
#include "catena/core/never_destroyed.h"

namespace catena {
namespace {

constexpr unsigned few = 4096;  // more processes are allowed to who is not meant to have few

bool tight(int resource, rlim_t enough) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur < enough;
}

/// To start all threads takes 10 us each, and so longer than many a search.
bool limits_are_tight() {
  unsigned allowed = few;
  std::ifstream("/sys/fs/cgroup/pids.max") >> allowed;  // of a container; "max", or no file: as it was, or 0
  return (allowed > 0 && allowed < few) || tight(RLIMIT_NPROC, few) || tight(RLIMIT_AS, RLIM_INFINITY);
}

/// All at once.
unsigned started(unsigned wanted) {
  std::atomic<bool> over = false;
  std::vector<std::jthread> threads;
  try {
    threads.reserve(wanted);
    while (threads.size() < wanted) threads.emplace_back([&] { over.wait(false); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  over = true;
  over.notify_all();
  return static_cast<unsigned>(threads.size());
}

}  // namespace

unsigned startable_threads(unsigned wanted) {
  static std::atomic<unsigned> asked = 0, found = 0;
  if (wanted <= asked) return std::min<unsigned>(wanted, found);
  static std::mutex asking;
  const std::scoped_lock lock(asking);
  if (wanted <= asked || found < asked) return std::min<unsigned>(wanted, found);
  const bool is_tight = limits_are_tight();
  const unsigned probed = is_tight ? wanted : 1, can = started(probed);
  if (can == 0) return 0;
  // Two teams at a time must not have more, nor others who use oneTBB. As long as the process lives.
  if (can < probed) {
    static const auto& limit = never_destroyed(std::make_unique<CoreLimit>(1 + can));
    static_cast<void>(limit);
  }
  found = is_tight ? can : wanted;
  asked = wanted;
  return found;
}

void refuse_threads() {
  throw CapacityError(
      "no thread can be started; raise ulimit -u or the container's limit of processes, or take threads=1");
}

}  // namespace catena

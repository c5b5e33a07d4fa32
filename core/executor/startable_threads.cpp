#include "catena/core/executor/startable_threads.h"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <new>
#include <string>
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

/// The control group allows few processes: "max", or no file, is none or 0.
bool few_in(const std::filesystem::path& group) {
  unsigned allowed = 0;
  std::ifstream(group / "pids.max") >> allowed;
  return allowed > 0 && allowed < few;
}
/// One of the groups that the process is in, a service's or a container's, or one around these: a line is
/// NUMBER:CONTROLLERS:PATH, without controllers in the unified hierarchy.
bool groups_allow_few() {
  const std::filesystem::path all = "/sys/fs/cgroup";
  if (few_in(all)) return true;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto controllers = line.find(':') + 1, path = line.find(':', controllers) + 1;
    if (controllers == 0 || path == 0) continue;
    const std::string by = line.substr(controllers, path - 1 - controllers);
    if (!by.empty() && by != "pids") continue;
    for (std::filesystem::path at = line.substr(path);; at = at.parent_path()) {
      if (few_in((all / by) / at.relative_path())) return true;
      if (!at.has_relative_path()) break;
    }
  }
  return false;
}
/// To start all threads takes 10 us each, and so longer than many a search.
bool limits_are_tight() {
  return tight(RLIMIT_NPROC, few) || tight(RLIMIT_AS, RLIM_INFINITY) || groups_allow_few();
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

/// Asked once for as many as any team has, before oneTBB has some, which it keeps.
unsigned all_startable() {
  constexpr unsigned any = ~0u;
  if (!limits_are_tight()) return started(1) == 1 ? any : 0;
  const unsigned all = std::max(usable_cores(), 2u) - 1;
  unsigned can = started(all);
  if (can == all) return any;
  if (tight(RLIMIT_AS, RLIM_INFINITY)) can = (can + 1) / 2;  // the search wants addresses, too
  if (can == 0) return 0;
  // Two teams at a time must not have more, nor others who use oneTBB. As long as the process lives.
  static const auto& limit = never_destroyed(std::make_unique<CoreLimit>(1 + can));
  static_cast<void>(limit);
  return can;
}

}  // namespace

unsigned startable_threads(unsigned wanted) {
  static std::atomic<unsigned> found = 0;
  static std::mutex asking;
  if (found == 0) {
    const std::scoped_lock lock(asking);
    if (found == 0) found = all_startable();
  }
  return std::min<unsigned>(wanted, found);
}

void refuse_threads() {
  throw CapacityError(
      "no thread can be started; raise ulimit -u or the container's limit of processes, or take threads=1");
}

}  // namespace catena

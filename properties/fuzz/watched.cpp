#include "catena/properties/fuzz/watched.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <system_error>

namespace catena::properties {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int killed_by_user = 130;  // as shells have it

volatile std::sig_atomic_t interrupts = 0;
volatile std::sig_atomic_t child_to_tell = 0;
volatile std::sig_atomic_t killed = 0;
volatile std::time_t first_interrupt = 0;

/// One key stroke may arrive twice, by the terminal and by whoever passes it on.
bool second_time() { return interrupts > 0 && std::time(nullptr) - first_interrupt > 1; }

void on_interrupt(int signal) {
  const int error = errno;
  if (interrupts == 0) first_interrupt = std::time(nullptr);
  killed = second_time();
  if (child_to_tell != 0) kill(static_cast<pid_t>(child_to_tell), killed ? SIGKILL : signal);
  interrupts = 1;
  errno = error;
}

/// Until the end of the block an interrupt is noted, here and in the child; there until it ends.
class NotesInterrupts {
 public:
  NotesInterrupts() {
    interrupts = 0;
    killed = 0;
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    sigemptyset(&action.sa_mask);
    for (std::size_t k = 0; k < 2; ++k) sigaction(signals[k], &action, &before_[k]);
  }
  ~NotesInterrupts() {
    if (for_good_) return;
    child_to_tell = 0;
    for (std::size_t k = 0; k < 2; ++k) sigaction(signals[k], &before_[k], nullptr);
  }
  /// In the child: an interrupt that comes twice must not end it once its work is done, before it has told
  /// of it. Who means to kill it asks the parent.
  void stay() { for_good_ = true; }
  NotesInterrupts(const NotesInterrupts&) = delete;
  NotesInterrupts& operator=(const NotesInterrupts&) = delete;

 private:
  static constexpr int signals[] = {SIGINT, SIGTERM};
  struct sigaction before_[2];
  bool for_good_ = false;
};

pid_t forked() {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start a process to watch");
  if (child == 0) prctl(PR_SET_PDEATHSIG, SIGKILL);
  return child;
}

/// Waits for the child's end, and kills it when it hangs; `hung` when it had to. Gives waitpid's status.
int outlast(pid_t child, const Notebook& notebook, double timeout, bool& hung) {
  const int handle =
      static_cast<int>(syscall(SYS_pidfd_open, child, 0));  // wakes at its end; old kernels have none
  const int look_every_ms = handle < 0 ? 5 : std::clamp(static_cast<int>(timeout * 100), 1, 200);
  std::uint64_t beats = notebook.beats();
  auto last = Clock::now();
  int status = 0;
  while (waitpid(child, &status, WNOHANG) != child) {
    pollfd end{handle, POLLIN, 0};
    poll(&end, 1, look_every_ms);
    if (notebook.beats() != beats) {
      beats = notebook.beats();
      last = Clock::now();
    } else if (timeout > 0 && !hung && Clock::now() - last > std::chrono::duration<double>(timeout)) {
      hung = true;
      kill(child, SIGKILL);
    }
  }
  if (handle >= 0) close(handle);
  return status;
}

Ending ending_of(pid_t child, const Notebook& notebook, double timeout) {
  bool hung = false;
  const int status = outlast(child, notebook, timeout, hung);
  if (killed) return {killed_by_user, ""};
  if (hung) return {0, fmt::format("hung: no end after {:g} s", timeout), true};
  if (WIFSIGNALED(status)) return {0, fmt::format("crashed: {}", strsignal(WTERMSIG(status)))};
  if (!notebook.ended()) return {0, fmt::format("ended the program with exit code {}", WEXITSTATUS(status))};
  return {WEXITSTATUS(status), ""};
}

/// Says at the end of the block, also by an exception, that the end is no crash.
struct EndsByItself {
  Notebook& notebook;
  ~EndsByItself() { notebook.end(); }
};

}  // namespace

bool interrupted() { return interrupts > 0; }

Ending watched(Notebook& notebook, double timeout, const std::function<int()>& work, bool& mine) {
  NotesInterrupts notes;
  const pid_t child = forked();
  mine = child == 0;
  if (mine) {
    notes.stay();
    const EndsByItself end{notebook};
    return {work(), ""};
  }
  child_to_tell = child;
  return ending_of(child, notebook, timeout);
}

Ending tried(Notebook& notebook, double timeout, const std::function<int()>& work) {
  const pid_t child = forked();
  if (child != 0) return ending_of(child, notebook, timeout);
  if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(2);  // the same complaint would come with each try
  int code = 2;
  try {
    code = work();
  } catch (...) {
  }
  notebook.end();
  _exit(code);
}

}  // namespace catena::properties

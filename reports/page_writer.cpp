#include "catena/reports/page_writer.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "catena/core/error.h"
#include "catena/core/installed_files.h"
#include "catena/core/notice.h"

namespace catena::reports {
namespace {

/// The folder that holds the package: beside an installed program, or in the source tree.
std::filesystem::path package_folder() {
  std::error_code ignored;
  const auto installed = installed_files();
  for (const auto& folder : {installed, std::filesystem::path(CATENA_REPORTS_IN_SOURCE)})
    if (std::filesystem::exists(folder / "catena_report" / "__main__.py", ignored)) return folder;
  throw InputError(
      fmt::format("the page writer catena_report is neither in {} nor in {}; install catena again",
                  installed.string(), CATENA_REPORTS_IN_SOURCE));
}

/// As `python -m catena_report`, but for the folder of the user, in front of all others with that, whose
/// files may have the names of modules. (Python 3.11 has -P for it.) And no compiled files come beside the
/// package: a source tree with new files calls itself changed, and an installed package keeps what was
/// installed.
constexpr const char* run_package = R"(import sys
sys.dont_write_bytecode = True
if sys.path[0] == "":
    del sys.path[0]
import runpy
runpy.run_module("catena_report", run_name="__main__", alter_sys=True))";

/// This process's environment with `folder` in front of PYTHONPATH.
std::vector<std::string> environment_with(const std::filesystem::path& folder) {
  constexpr std::string_view name = "PYTHONPATH=";
  std::vector<std::string> variables;
  std::string path = folder.string();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable = *entry;
    if (!variable.starts_with(name))
      variables.emplace_back(variable);
    else if (variable.size() > name.size())  // else an empty entry would be the current folder
      path.append(":").append(variable.substr(name.size()));
  }
  variables.push_back(fmt::format("{}{}", name, path));
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (auto& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

/// As system() does: at Ctrl-C the page writer, which gets it too, ends first and cleans up.
class InterruptsLeftToChild {
 public:
  InterruptsLeftToChild() : before_(std::signal(SIGINT, SIG_IGN)) {
    sigset_t interrupts;
    sigemptyset(&interrupts);
    if (before_ != SIG_IGN) sigaddset(&interrupts, SIGINT);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigdefault(&attributes_, &interrupts);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
  }
  ~InterruptsLeftToChild() {
    posix_spawnattr_destroy(&attributes_);
    std::signal(SIGINT, before_);
  }
  InterruptsLeftToChild(const InterruptsLeftToChild&) = delete;
  InterruptsLeftToChild& operator=(const InterruptsLeftToChild&) = delete;

  const posix_spawnattr_t* attributes() const { return &attributes_; }
  /// Ends this process as the child was ended, after a line that says what is left.
  void pass_on(const std::string& left) const {
    if (!left.empty()) notice("catena", left);
    std::signal(SIGINT, SIG_DFL);
    raise(SIGINT);
  }

 private:
  posix_spawnattr_t attributes_;
  void (*before_)(int);
};

}  // namespace

int run_page_writer(const std::vector<std::string>& arguments, const std::string& left_if_interrupted) {
  std::vector<std::string> command{CATENA_PYTHON, "-c", run_package};
  command.insert(command.end(), arguments.begin(), arguments.end());
  auto variables = environment_with(package_folder());
  pid_t child = 0;
  const InterruptsLeftToChild waiting;
  const int failed = posix_spawnp(&child, CATENA_PYTHON, nullptr, waiting.attributes(),
                                  pointers(command).data(), pointers(variables).data());
  if (failed != 0)
    throw InputError(fmt::format("cannot run {}: {}; install python3", CATENA_PYTHON, std::strerror(failed)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw InputError(fmt::format("lost {}: {}", CATENA_PYTHON, std::strerror(errno)));
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) waiting.pass_on(left_if_interrupted);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 2;
}

}  // namespace catena::reports

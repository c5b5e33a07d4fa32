#include "catena/reports/page_writer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

/// How the page writer is run, told by what Python runs before any package: a file usercustomize.py, which
/// ends it as the last argument says.
namespace catena::reports {
namespace {

constexpr const char* before_the_package = R"(
import os, signal, sys
print(os.environ["PYTHONPATH"], signal.getsignal(signal.SIGINT) is signal.SIG_IGN, *sys.orig_argv[3:], flush=True)
if sys.orig_argv[-1] == "exit":
    os._exit(7)
ends = getattr(signal, sys.orig_argv[-1])
if ends == signal.SIGINT:
    signal.signal(ends, signal.SIG_DFL)
os.kill(os.getpid(), ends)
)";

TEST(PageWriter, HasThePackageItsArgumentsAndInterrupts) {
  namespace fs = std::filesystem;
  const fs::path base = testing::TempDir() + fmt::format("catena_python_{}", getpid());
  for (int minor = 9; minor < 20; ++minor) {
    const fs::path site = base / "lib" / fmt::format("python3.{}", minor) / "site-packages";
    fs::create_directories(site);
    std::ofstream(site / "usercustomize.py") << before_the_package;
  }
  setenv("PYTHONUSERBASE", base.c_str(), 1);
  setenv("PYTHONPATH", "/nowhere", 1);
  const auto run = [](const std::string& how, int code) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(run_page_writer({"--output", how}), code) << how;
    return testing::internal::GetCapturedStdout();
  };
  const auto handler = [](int) {};
  for (const bool ignored : {false, true}) {
    std::signal(SIGINT, ignored ? SIG_IGN : +handler);
    const std::string how = ignored ? "SIGKILL" : "exit", said = run(how, ignored ? 2 : 7);
    EXPECT_TRUE(said.ends_with(fmt::format(":/nowhere {} --output {}\n", ignored ? "True" : "False", how)))
        << said;
    EXPECT_TRUE(fs::exists(fs::path(said.substr(0, said.find(':'))) / "catena_report" / "__main__.py"))
        << said;
    EXPECT_EQ(std::signal(SIGINT, SIG_DFL), ignored ? SIG_IGN : +handler) << "as it was before";
  }
  EXPECT_EXIT(run_page_writer({"SIGINT"}); std::exit(0), testing::KilledBySignal(SIGINT), "^$");
  EXPECT_EXIT(run_page_writer({"SIGINT"}, "the run is kept");
              std::exit(0), testing::KilledBySignal(SIGINT), "^catena: the run is kept\n$");
  unsetenv("PYTHONUSERBASE");
  unsetenv("PYTHONPATH");
  fs::remove_all(base);
}

/// Puts the current folder and PYTHONPATH back as they were, also where a test throws.
class Surroundings {
 public:
  Surroundings() {
    if (const char* path = std::getenv("PYTHONPATH")) path_ = path;
  }
  ~Surroundings() {
    std::error_code ignored;  // a destructor may not throw
    std::filesystem::current_path(folder_, ignored);
    path_ ? setenv("PYTHONPATH", path_->c_str(), 1) : unsetenv("PYTHONPATH");
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

 private:
  std::filesystem::path folder_ = std::filesystem::current_path();
  std::optional<std::string> path_;
};

/// A file of the user's with the name of a module is none, though to Python an empty PYTHONPATH beside
/// another folder is the current one.
TEST(PageWriter, RunsNothingOfTheCurrentFolder) {
  namespace fs = std::filesystem;
  const fs::path folder = testing::TempDir() + fmt::format("catena_users_folder_{}", getpid());
  fs::create_directories(folder);
  for (const char* module : {"runpy", "json", "argparse", "numpy", "catena_report"})
    std::ofstream(folder / fmt::format("{}.py", module)) << "open('taken', 'w')\nraise SystemExit(99)\n";
  for (const bool empty : {false, true}) {
    int code = -1;
    testing::internal::CaptureStdout();
    {
      const Surroundings as_before;
      empty ? setenv("PYTHONPATH", "", 1) : unsetenv("PYTHONPATH");
      fs::current_path(folder);
      code = run_page_writer({"--help"});
    }
    const std::string said = testing::internal::GetCapturedStdout();
    EXPECT_FALSE(fs::exists(folder / "taken")) << empty;
    EXPECT_EQ(code, 0) << said;
    EXPECT_NE(said.find("usage"), std::string::npos) << said;
  }
  fs::remove_all(folder);
}

/// Python would write what it compiles beside the package, and a source tree with new files calls itself
/// changed.
TEST(PageWriter, LeavesNothingBesideThePackage) {
  namespace fs = std::filesystem;
  const fs::path compiled = testing::TempDir() + fmt::format("catena_compiled_{}", getpid());
  fs::remove_all(compiled);
  const auto run = [&] {
    unsetenv("PYTHONDONTWRITEBYTECODE");
    setenv("PYTHONPYCACHEPREFIX", compiled.c_str(), 1);  // where it would be written instead
    std::exit(run_page_writer({}));
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(2), "give --output DIR");
  std::error_code none;
  for (fs::recursive_directory_iterator at(compiled, none), end; at != end; ++at)
    EXPECT_NE(at->path().filename(), "catena_report") << at->path();
  fs::remove_all(compiled);
}

}  // namespace
}  // namespace catena::reports

#include "catena/core/commands/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace catena {
namespace {

using namespace std::chrono_literals;

std::string bar(const std::string& done, const std::string& share, const std::string& doing) {
  return "\r\033[K[" + done + std::string(24 - done.size(), ' ') + "] " + share + "% " + doing;
}

TEST(Progress, IsNothingForAFile) {
  testing::internal::CaptureStderr();
  {
    Progress progress(2);
    std::this_thread::sleep_for(1050ms);
    progress.step("first");
    progress.clear();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// What a terminal is shown of it: nothing in the first second, then what is done, and in the end nothing
/// again.
TEST(Progress, IsALineThatATerminalShowsAndForgets) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) GTEST_SKIP() << "no terminals here";
  const int seen_by_us = open(ptsname(terminal), O_RDWR | O_NOCTTY), before = dup(STDERR_FILENO);
  if (seen_by_us < 0) GTEST_SKIP() << "no terminals here";
  const auto shown = [&] {
    std::string text(4096, '\0');
    const ssize_t size = read(terminal, text.data(), text.size());
    text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return text;
  };
  std::fflush(stderr);
  dup2(seen_by_us, STDERR_FILENO);
  std::string early, late, crowded, gone, twice;
  {
    Progress progress(4);
    progress.step("one");
    progress.clear();
    early = shown();
    std::this_thread::sleep_for(1050ms);
    progress.step("two, " + std::string(80, 'x'));
    late = shown();
    progress.step("three");
    crowded = shown();
    progress.clear();
    gone = shown();
    progress.clear();
    twice = shown();
  }
  dup2(before, STDERR_FILENO);
  close(before), close(seen_by_us), close(terminal);
  EXPECT_EQ(early, "");
  EXPECT_EQ(late, bar("######", " 25", "two, " + std::string(39, 'x'))) << "within 80 columns";
  EXPECT_EQ(crowded, "") << "not more than ten in a second";
  EXPECT_EQ(gone, "\r\033[K");
  EXPECT_EQ(twice, "");
}

}  // namespace
}  // namespace catena

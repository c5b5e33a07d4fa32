#include "catena/core/commands/guarded_main.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "catena/core/error.h"

namespace catena {
namespace {

struct Outcome {
  int code;
  std::string said;  ///< on standard error
};

Outcome of(const std::function<int()>& body) {
  testing::internal::CaptureStderr();
  const int code = guarded_main("program", body);
  return {code, testing::internal::GetCapturedStderr()};
}

template <class Thrown>
void expect_one_line(const Thrown& thrown, const std::string& line) {
  const Outcome outcome = of([&]() -> int { throw thrown; });
  EXPECT_EQ(outcome.code, 2) << line;
  EXPECT_EQ(outcome.said, line + "\n");
}

TEST(GuardedMain, GivesTheExitCodeOfItsBody) {
  for (const int code : {0, 1, 2}) {
    const Outcome outcome = of([&] { return code; });
    EXPECT_EQ(outcome.code, code);
    EXPECT_EQ(outcome.said, "");
  }
}

TEST(GuardedMain, SaysEveryExceptionInOneLine) {
  expect_one_line(InputError("no scene\nis named so"), "program: no scene is named so");
  expect_one_line(CapacityError("too long"), "program: too long");
  expect_one_line(std::bad_alloc(), "program: out of memory; take fewer spheres");
  expect_one_line(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)),
                  "program: Resource temporarily unavailable");
  expect_one_line(std::logic_error("find before build"),
                  "program: internal error: find before build; please report it with the command line");
  expect_one_line(std::runtime_error("unforeseen"),
                  "program: internal error: unforeseen; please report it with the command line");
  expect_one_line(7, "program: internal error of an unknown kind; please report it with the command line");
}

/// Lost in the middle, whatever was written after it; the system's reason is long forgotten.
TEST(GuardedMain, SaysThatOutputWasLostEarlier) {
  std::fflush(stdout);
  const Outcome outcome = of([] {
    const int out = dup(STDOUT_FILENO), full = open("/dev/full", O_WRONLY);
    dup2(full, STDOUT_FILENO);
    const std::string lost(1 << 20, 'x');
    EXPECT_LT(std::fwrite(lost.data(), 1, lost.size(), stdout), lost.size());
    dup2(out, STDOUT_FILENO);
    close(out), close(full);
    return 0;
  });
  std::clearerr(stdout);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.said, "program: cannot write the output\n");
}

}  // namespace
}  // namespace catena

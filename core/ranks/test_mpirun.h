#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "catena/core/commands/test_program.h"

namespace catena {

/// The program under mpirun, three processes on whatever cores there are.
class Mpirun : public Program {
 protected:
  void SetUp() override {
    if (std::string_view(CATENA_MPIRUN).empty()) GTEST_SKIP() << "built without MPI";
    if (!std::filesystem::exists(CATENA_MPIRUN)) GTEST_SKIP() << "there is no " << CATENA_MPIRUN;
  }

  /// `before` are settings of the environment, `limit` seconds. --quiet, as mpirun tells of every exit code
  /// by many lines of its own; and it does not wait a second before it kills what another rank's failure left
  /// running. Without what libevent in mpirun warns of now and then, when a rank has ended before mpirun is
  /// done with the rank's standard input.
  ProgramOutcome run_ranks(const std::string& arguments, unsigned ranks = 3, const std::string& before = "",
                           unsigned limit = 120) const {
    const char* const as_root = geteuid() == 0 ? "--allow-run-as-root" : "";
    ProgramOutcome outcome = shell(
        fmt::format("{} OMPI_MCA_odls_base_sigkill_timeout=0 ASAN_OPTIONS=detect_leaks=0 timeout {} '{}' "
                    "--quiet --oversubscribe {} -n {} '{}' {} > '{}'",
                    before, limit, CATENA_MPIRUN, as_root, ranks, CATENA_PROGRAM, arguments, file("out")));
    std::string& text = outcome.output;
    for (std::size_t line = 0; line < text.size();) {
      const std::size_t next = std::min(text.find('\n', line), text.size() - 1) + 1;
      if (text.compare(line, libevent.size(), libevent) == 0)
        text.erase(line, next - line);
      else
        line = next;
    }
    return outcome;
  }
  void expect_one_line(const ProgramOutcome& r, const std::string& because) const {
    EXPECT_EQ(r.code, 2) << r.output;
    EXPECT_EQ(std::ranges::count(r.output, '\n'), 1) << r.output;
    EXPECT_TRUE(r.output.starts_with("catena: ")) << r.output;
    EXPECT_NE(r.output.find(because), std::string::npos) << r.output;
  }

 private:
  static constexpr std::string_view libevent = "[warn] Epoll ";
};

}  // namespace catena

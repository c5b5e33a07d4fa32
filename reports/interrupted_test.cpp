#include "catena/reports/interrupted.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace catena::reports {
namespace {

/// As under nohup: what the user asked to go on goes on.
TEST(SaidIfInterrupted, EndsByTheSignalAndLeavesAnIgnoredOneIgnored) {
  const auto end = [](int signal, bool ignored) {
    std::signal(signal, ignored ? SIG_IGN : SIG_DFL);
    {
      const SaidIfInterrupted said("what was measured is kept");
      std::raise(signal);
    }
    std::exit(std::signal(signal, SIG_DFL) == SIG_IGN ? 0 : 1);
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(end(signal, false), testing::KilledBySignal(signal), "^what was measured is kept\n$");
    EXPECT_EXIT(end(signal, true), testing::ExitedWithCode(0), "^$") << signal;
  }
}

}  // namespace
}  // namespace catena::reports

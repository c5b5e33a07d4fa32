#include "catena/reports/interrupted.h"

#include <unistd.h>

#include <array>
#include <csignal>

namespace catena::reports {
namespace {

constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, signals.size()> before;
std::string line_said;  // not touched while the handler is installed

/// Only what a signal handler may call. The signal comes again once it has its old meaning and is let
/// through.
void say(int signal) {
  const auto written = write(STDERR_FILENO, line_said.data(), line_said.size());
  static_cast<void>(written);
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before[k], nullptr);
  raise(signal);
}

}  // namespace

SaidIfInterrupted::SaidIfInterrupted(const std::string& line) {
  line_said = (isatty(STDERR_FILENO) ? "\n" : "") + line + '\n';
  struct sigaction action {};
  action.sa_handler = say;
  sigfillset(&action.sa_mask);
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sigaction(signals[k], nullptr, &before[k]);
    if (before[k].sa_handler != SIG_IGN) sigaction(signals[k], &action, nullptr);
  }
}

SaidIfInterrupted::~SaidIfInterrupted() {
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before[k], nullptr);
}

}  // namespace catena::reports

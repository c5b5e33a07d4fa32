#include "catena/core/commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace catena {
namespace {

/// Not fmt::print, which throws when the terminal is gone: clear() is called by a destructor.
void show(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(std::uint64_t total)
    : total_(std::max<std::uint64_t>(total, 1)), terminal_(isatty(STDERR_FILENO)) {}

void Progress::step(std::string_view doing) {
  using namespace std::chrono_literals;
  ++begun_;
  if (!terminal_) return;
  const auto now = Clock::now();
  if (now - start_ < 1s || (drawn_ && now - last_ < 100ms)) return;
  last_ = now;
  draw(doing);
}

void Progress::draw(std::string_view doing) {
  constexpr std::uint64_t width = 24;
  constexpr std::size_t room =
      44;  // the whole line stays within 80 columns: a wrapped bar cannot be taken back
  const std::uint64_t done = std::min(begun_, total_) - 1;
  const std::string bar(width * done / total_, '#');
  show(fmt::format("\r\033[K[{:<{}}] {:3}% {}", bar, width, 100 * done / total_, doing.substr(0, room)));
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  show("\r\033[K");
  drawn_ = false;
}

}  // namespace catena

#pragma once
#include <chrono>
#include <cstdint>
#include <string_view>

namespace catena {

/// A progress bar for work of known length. It is drawn on stderr, only when that is a terminal, and only
/// once the work has taken a second; piped output and quick work never see it. One thread at a time.
class Progress {
 public:
  explicit Progress(std::uint64_t total);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One step begins; `doing` says what, in a few words. Draws at most ten times a second.
  void step(std::string_view doing);
  /// Takes the bar off the screen: call it before printing a line that is to stay.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::string_view doing);

  std::uint64_t total_, begun_ = 0;
  bool terminal_, drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace catena

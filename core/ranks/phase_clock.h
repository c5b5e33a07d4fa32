#pragma once
#include <array>
#include <chrono>
#include <ctime>

#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// How long each phase of a search took a rank, by the clock and of the processor: what its own thread
/// computed, without waiting for others.
class PhaseClock {
 public:
  static constexpr std::size_t phases = static_cast<std::size_t>(Phase::done) + 1;
  using Milliseconds = std::array<double, phases>;

  void enter(Phase phase) {
    const Now now = Now::read();
    if (running_) {
      ms_[at_] += now.wall - since_.wall;
      processor_ms_[at_] += now.processor - since_.processor;
    }
    at_ = static_cast<std::size_t>(phase), since_ = now, running_ = phase != Phase::done;
  }
  const Milliseconds& ms() const { return ms_; }
  const Milliseconds& processor_ms() const { return processor_ms_; }

 private:
  struct Now {
    double wall, processor;
    static Now read() {
      timespec used{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
      const std::chrono::duration<double, std::milli> wall =
          std::chrono::steady_clock::now().time_since_epoch();
      return {wall.count(),
              1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec)};
    }
  };

  Milliseconds ms_{}, processor_ms_{};
  std::size_t at_ = 0;
  bool running_ = false;
  Now since_{};
};

}  // namespace catena::ranks

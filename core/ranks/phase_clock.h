#pragma once
#include <array>
#include <chrono>

#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// How long each phase of a search took a rank.
class PhaseClock {
 public:
  static constexpr std::size_t phases = static_cast<std::size_t>(Phase::done) + 1;
  using Milliseconds = std::array<double, phases>;

  void enter(Phase phase) {
    const auto now = std::chrono::steady_clock::now();
    if (running_) ms_[at_] += std::chrono::duration<double, std::milli>(now - since_).count();
    at_ = static_cast<std::size_t>(phase), since_ = now, running_ = phase != Phase::done;
  }
  const Milliseconds& ms() const { return ms_; }

 private:
  Milliseconds ms_{};
  std::size_t at_ = 0;
  bool running_ = false;
  std::chrono::steady_clock::time_point since_;
};

}  // namespace catena::ranks

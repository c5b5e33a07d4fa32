#pragma once
#include <array>
#include <cstdint>

#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// The most memory that this process held in each phase of a search; what came before the first one counts to
/// it. Of Linux, by VmHWM; 0 elsewhere.
class PhasePeaks {
 public:
  static constexpr std::size_t phases = static_cast<std::size_t>(Phase::done) + 1;
  using Kib = std::array<std::uint64_t, phases>;

  void enter(Phase phase);
  const Kib& kib() const { return kib_; }

 private:
  Kib kib_{};
  std::size_t at_ = 0;
};

}  // namespace catena::ranks

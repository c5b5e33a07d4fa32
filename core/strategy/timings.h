#pragma once
#include <chrono>

#include "catena/core/export.h"

namespace catena {

/// Milliseconds of the last build or update and of the last find. Host stages are wall time; device stages
/// are CUDA events around the kernels. Moves between memories are never part of a stage, nor is what a first
/// call on a device adds.
struct CATENA_API Timings {
  double build_ms = 0;
  double find_ms = 0;
  double transfer_ms = 0;
  double start_ms = 0;  ///< wall time of a first call: device code loaded, memory taken; else 0
};

/// Wall clock of one stage.
class CATENA_API Stopwatch {
 public:
  double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <string>

namespace catena {

/// How often the last find took a step: what its time goes into, free of noise. A step on several things at a
/// time counts once, so that numbers may differ between machines with vectors of different lengths.
struct WorkDone {
  std::string step;
  std::uint64_t times = 0;
};

}  // namespace catena

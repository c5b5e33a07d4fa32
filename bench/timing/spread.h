#pragma once
#include <vector>

namespace catena::bench {

/// Milliseconds of one case over its repetitions.
struct Spread {
  double least = 0, lower = 0, median = 0, upper = 0;  ///< minimum and quartiles
  static Spread of(std::vector<double> samples);       ///< at least one sample
};

}  // namespace catena::bench

#pragma once
#include <vector>

namespace catena::bench {

/// A confidence interval of a median from order statistics: no assumption on the distribution of the samples
/// but that they are independent draws of one.
struct MedianInterval {
  double median = 0, lower = 0, upper = 0;
  bool bounded = false;  ///< false: too few samples for 95 %; fewer than 6
  /// Width over median; infinite when not bounded.
  double relative_width() const;
};

/// At least 95 %: the narrowest pair of order statistics k and N + 1 - k with P(Binomial(N, 1/2) < k) <= 2.5
/// %. Throws std::invalid_argument without samples. O(N log N).
MedianInterval median_interval(std::vector<double> samples);

}  // namespace catena::bench

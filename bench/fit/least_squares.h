#pragma once
#include <vector>

namespace catena::bench {

/// The coefficients for which the sum of squares of (coefficients * terms - value) over all rows is least.
struct LeastSquares {
  std::vector<double> best;
  std::vector<double> variance;  ///< of each, for errors of the values of variance 1
  double rest = 0;               ///< that sum
};

/// `terms` has a row for each value, all of one length. Throws std::logic_error where there are fewer rows
/// than coefficients, or rows of another length.
LeastSquares least_squares(const std::vector<std::vector<double>>& terms, const std::vector<double>& values);

}  // namespace catena::bench

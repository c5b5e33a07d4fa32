#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/timing/spread.h"

namespace catena::bench {

/// One point of error against run time.
struct Point {
  std::string tube, variant, arithmetic;
  std::size_t n = 0;
  double tube_error = 0;  ///< Hausdorff gap of the chain over the radius of the tube
  double answer_error =
      0;  ///< pairs missing and invented over the exact pairs; 0 when there is nothing wrong
  std::size_t repetitions = 0;
  Spread time;
  std::optional<std::size_t> dominated_by;  ///< empty: on the Pareto front
  double offset = 0;                        ///< of the chain from the origin along every axis, in radii
};

/// Marks each point for which another has no more of either error and is faster beyond the spread: its upper
/// quartile lies below the lower quartile of the point. Of several such, the one with the least median is
/// named. O(points^2).
void mark_dominated(std::vector<Point>& points);

}  // namespace catena::bench

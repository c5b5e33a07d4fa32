#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/timing/spread.h"

namespace catena::bench {

/// One point of error against run time.
struct Point {
  std::string tube, variant, arithmetic;
  std::size_t n = 0;
  /// Three errors apart. Of the tube: the Hausdorff gap of the chain over the radius of the tube.
  double tube_error = 0;
  /// Of storing: how far the farthest stored centre is from its place, over the radius.
  double stored_error = 0;
  /// Of the answer: pairs missing and invented over the exact pairs; 0 when there is nothing wrong.
  double answer_error = 0;
  std::uint64_t exact_pairs = 0, missing = 0, invented = 0;
  double worst_margin = 0;  ///< largest |q - t| / t of a wrong decision: the error of the arithmetic
  /// Of the pairs missing the deepest, of those invented the one farthest apart: | |cA - cB| - (rA + rB) |,
  /// over the radius of the tube.
  double depth_error = 0;
  std::size_t repetitions = 0;
  Spread time{};
  std::optional<std::size_t> dominated_by{};  ///< empty: on the Pareto front
  std::optional<double> tolerance{};  ///< n is what this share of the radius asks for, see spheres_for
  double offset = 0;                  ///< of the chain from the origin along every axis, in radii
};

/// Marks each point for which another has no more of either error and is faster beyond the spread: its upper
/// quartile lies below the lower quartile of the point. Of several such, the one with the least median is
/// named. O(points^2).
void mark_dominated(std::vector<Point>& points);

}  // namespace catena::bench

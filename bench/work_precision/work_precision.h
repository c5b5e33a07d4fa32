#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/bench/tube/tube.h"
#include "catena/bench/work_precision/pareto.h"

namespace catena::bench {

struct WorkPrecision {
  std::vector<Point> points;
  std::vector<std::string> left_out;  ///< variant and reason, once each
};

/// Error against run time: the inscribed chain of each size on the tube, moved by `offset` on every axis,
/// found by every variant; and that of as many spheres as each tolerance, a share of the radius, asks for.
/// Each variant first answers and is compared with the exact reference; then all are timed (build and find
/// together, wall time, transfers included), interleaved in a fresh random order each round, for
/// `repetitions` rounds. O(n^2) variants are left out above 5,000 spheres. A variant whose arithmetic must be
/// exact and is not is an InputError: no time is given for a wrong answer that nothing excuses.
WorkPrecision work_precision(const Tube& tube, const std::vector<std::uint32_t>& sizes,
                             const std::vector<std::string>& variants, std::size_t repetitions,
                             double offset = 0, const std::vector<double>& tolerances = {});

}  // namespace catena::bench

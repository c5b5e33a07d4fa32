#include "catena/bench/work_precision/pareto.h"

namespace catena::bench {
namespace {

bool dominates(const Point& a, const Point& b) {
  return a.tube_error <= b.tube_error && a.answer_error <= b.answer_error && a.time.upper < b.time.lower;
}

}  // namespace

void mark_dominated(std::vector<Point>& points) {
  for (Point& point : points) {
    point.dominated_by.reset();
    for (std::size_t k = 0; k < points.size(); ++k)
      if (dominates(points[k], point) &&
          (!point.dominated_by || points[k].time.median < points[*point.dominated_by].time.median))
        point.dominated_by = k;
  }
}

}  // namespace catena::bench

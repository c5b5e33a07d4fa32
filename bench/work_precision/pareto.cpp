#include "catena/bench/work_precision/pareto.h"

#include <algorithm>
#include <cmath>

namespace catena::bench {
namespace {

bool dominates(const Point& a, const Point& b) {
  return a.tube_error <= b.tube_error && a.answer_error <= b.answer_error && a.time.upper < b.time.lower;
}

}  // namespace

Spread Spread::of(std::vector<double> samples) {
  std::ranges::sort(samples);
  const auto at = [&](double share) {  // linear between neighbours, as most statistics programs do
    const double place = share * static_cast<double>(samples.size() - 1), below = std::floor(place);
    const auto k = static_cast<std::size_t>(below);
    const double next = samples[std::min(k + 1, samples.size() - 1)];
    return samples[k] + (place - below) * (next - samples[k]);
  };
  return {samples.front(), at(0.25), at(0.5), at(0.75)};
}

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

#include "catena/core/scenes/random_walk.h"

#include <cmath>

namespace catena {

std::vector<Vec3> random_walk(std::uint32_t n, double step, double persistence, Random random) {
  // A heading disturbed by `kick` in a random direction keeps 1 - kick^2 / 3 of itself on average.
  const double kick = std::sqrt(3 * step / persistence);
  std::vector<Vec3> points;
  points.reserve(n);
  Vec3 centre, heading{1, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    points.push_back(centre);
    const Vec3 disturbed = heading + kick * random.direction();
    const double size = length(disturbed);
    if (size > 1e-9)
      heading = 1 / size * disturbed;  // a kick straight back leaves no direction: keep the old one
    centre = centre + step * heading;
  }
  return points;
}

}  // namespace catena

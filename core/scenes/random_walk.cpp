#include "catena/core/scenes/random_walk.h"

#include <cmath>

namespace catena {

// A heading disturbed by `kick` in a random direction keeps 1 - kick^2 / 3 of itself on average.
RandomWalk::RandomWalk(double step, double persistence, const Random& random)
    : step_(step), kick_(std::sqrt(3 * step / persistence)), random_(random) {}

Vec3 RandomWalk::operator()() {
  const Vec3 here = centre_;
  const Vec3 disturbed = heading_ + kick_ * random_.direction();
  const double size = length(disturbed);
  if (size > 1e-9)
    heading_ = 1 / size * disturbed;  // a kick straight back leaves no direction: keep the old one
  centre_ = centre_ + step_ * heading_;
  return here;
}

}  // namespace catena

#pragma once
#include "catena/core/scenes/random.h"
#include "catena/core/vec3.h"

namespace catena {

/// Points `step` apart, from the origin on: a walk that forgets its direction over the length `persistence`.
class RandomWalk {
 public:
  RandomWalk(double step, double persistence, const Random& random);

  /// The next point. O(1).
  Vec3 operator()();

 private:
  double step_, kick_;
  Random random_;
  Vec3 centre_, heading_{1, 0, 0};
};

}  // namespace catena

#pragma once

namespace catena {

/// A point of the unit circle.
struct CirclePoint {
  double cosine, sine;
};

/// cos and sin of `turns` full turns, |turns| < 2^52. Absolute error below 4e-16 for the fraction of a turn,
/// which is reduced exactly; multiples of 1/4 are exact. Made of + - * and floor alone: unlike std::sin, it
/// has the same bits with every C library, and so have the scenes.
CirclePoint circle_point(double turns);

}  // namespace catena

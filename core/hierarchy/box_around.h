#pragma once
#include <span>

#include "catena/core/hierarchy/box.h"
#include "catena/core/sphere_vector.h"

namespace catena {
namespace box_around_detail {

using sphere_vector::Bits, sphere_vector::Four, sphere_vector::four, sphere_vector::magnitude;

/// The rounded lower ends along each axis, and something in the fourth place.
inline Four low_of(Four sphere) { return sphere - sphere[3]; }
/// The upper ends likewise.
inline Four high_of(Four sphere) { return sphere + sphere[3]; }
/// Lower ends moved outward; see Box::around.
inline Four moved_down(Four low) { return low - magnitude(low) * 0x1p-23f; }
/// Upper ends likewise.
inline Four moved_up(Four high) { return high + magnitude(high) * 0x1p-23f; }

}  // namespace box_around_detail

/// A box around consecutive spheres, at least one: as the boxes of Box::around joined. Ends are moved outward
/// after the least and the greatest are known, as moving is monotone.
inline Box box_around(std::span<const Sphere> spheres) {
  using namespace box_around_detail;
  // Two at a time, as each minimum waits for the one before.
  const Four first = four(spheres.front()), last = four(spheres.back());
  Four low = low_of(first), high = high_of(first), other_low = low_of(last), other_high = high_of(last);
  const auto take = [](const Sphere& s, Four& least, Four& greatest) {
    const Four sphere = four(s), down = low_of(sphere), up = high_of(sphere);
    least = down < least ? down : least;
    greatest = up > greatest ? up : greatest;
  };
  for (std::size_t k = 1; k + 1 < spheres.size(); k += 2) {
    take(spheres[k], low, high);
    take(spheres[k + 1], other_low, other_high);
  }
  low = moved_down(other_low < low ? other_low : low);
  high = moved_up(other_high > high ? other_high : high);
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

/// Says of spheres whether the boxes around them meet one box.
class MeetsBox {
 public:
  explicit MeetsBox(const Box& box)
      : low_{box.low[0], box.low[1], box.low[2], 0}, high_{box.high[0], box.high[1], box.high[2], 0} {}

  bool operator()(const Sphere& s) const {
    using namespace box_around_detail;
    const Four sphere = four(s);
    const Bits meets = (moved_down(low_of(sphere)) <= high_) & (low_ <= moved_up(high_of(sphere)));
    return (meets[0] & meets[1] & meets[2]) != 0;
  }
  bool any_of(std::span<const Sphere> spheres) const {
    for (const Sphere& s : spheres)
      if ((*this)(s)) return true;
    return false;
  }

 private:
  box_around_detail::Four low_, high_;
};

}  // namespace catena

#include "catena/core/ranks/told_block.h"

#include <algorithm>
#include <cmath>

#include "catena/core/rounded_up.h"
#include "catena/core/vec3.h"

// In binary64, in which no square of what comes from binary32 overflows or is lost
// (properties/proofs/told_block_binary64.g).
namespace catena::ranks {
namespace {

constexpr double slack = 0x1p-40, rounding = 0x1p-50;

Vec3 vector(const float (&end)[3]) { return {end[0], end[1], end[2]}; }
Vec3 centre(const Sphere& s) { return {s.x, s.y, s.z}; }
double sides(const Vec3& a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

/// From the first end to the last, and what lies beside it.
class Axis {
 public:
  explicit Axis(const ToldBlock& told) : first_(vector(told.first)), axis_(vector(told.last) - first_) {
    const double square = dot(axis_, axis_);
    if (square > 0) over_square_ = 1 / square;
  }
  Vec3 to(const Sphere& point) const { return centre(point) - first_; }
  /// From a place on the axis, about the nearest one, to where `to` leads. Any place will do: it gives a
  /// radius that is large enough, and a direction to look for a gap in.
  Vec3 across(const Vec3& to) const {
    return to - std::clamp(dot(axis_, to) * over_square_, 0.0, 1.0) * axis_;
  }
  /// How far `to` leads beyond either end in that direction, times its length.
  double gap(const Vec3& to, const Vec3& direction) const {
    const double at_first = dot(to, direction);
    return std::min(at_first, at_first - dot(axis_, direction));
  }
  /// What rounding makes of any of these lengths is less.
  double lost(const Vec3& to) const { return slack * (sides(axis_) + sides(to)); }

 private:
  Vec3 first_, axis_;
  double over_square_ = 0;
};

}  // namespace

ToldBlock ToldBlock::along(std::uint32_t block, std::span<const Sphere> spheres) {
  const Sphere &a = spheres.front(), &b = spheres.back();
  return {block, {a.x, a.y, a.z}, {b.x, b.y, b.z}, 0};
}

void ToldBlock::hold(std::span<const Sphere> spheres) {
  const Axis axis(*this);
  double least = 0;
  for (const Sphere& s : spheres) {
    const Vec3 to = axis.to(s);
    least = std::max(least, length(axis.across(to)) + s.radius + axis.lost(to));
  }
  radius = rounded_up(least * (1 + rounding));
}

Box ToldBlock::box() const {
  Box box = Box::around({first[0], first[1], first[2], radius});
  box.join(Box::around({last[0], last[1], last[2], radius}));
  return box;
}

bool ToldBlock::may_touch(const Sphere& sphere) const {
  const Axis axis(*this);
  const Vec3 to = axis.to(sphere), across = axis.across(to);
  const double gap = axis.gap(to, across), reach = double{radius} + sphere.radius + axis.lost(to);
  return !(gap > 0 && gap * gap > reach * reach * dot(across, across));
}

}  // namespace catena::ranks

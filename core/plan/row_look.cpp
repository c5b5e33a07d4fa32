#include "catena/core/plan/row_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "catena/core/space_tree/scattered.h"
#include "catena/core/sphere_vector.h"
#include "catena/core/vec3.h"

namespace catena {
namespace {

using namespace sphere_vector;

constexpr std::uint32_t row_size = 8;

/// Some of a row's spheres, and where they lie, about: not a Box, which encloses for certain, nor a capsule.
/// These take longer, and nothing but time depends on this.
class Row {
 public:
  explicit Row(const Sphere* of) : first_(of[0]), middle_(of[row_size / 2]), last_(of[row_size - 1]) {
    const Four a = four(first_), b = four(middle_), c = four(last_);
    const Four most = greater(greater(a, b), c), radius = Four{} + most[3];
    low_ = lesser(lesser(a, b), c) - radius, high_ = most + radius;
    radius_ = most[3];
  }
  bool meets(const Row& other) const {
    const Bits apart = (low_ > other.high_) | (other.low_ > high_);
    return (apart[0] | apart[1] | apart[2]) == 0 && !Thick(*this).lies_apart_from(Thick(other));
  }

 private:
  static Four lesser(Four a, Four b) { return b < a ? b : a; }
  static Four greater(Four a, Four b) { return a < b ? b : a; }

  /// As a thick line from the first to the last, moved by half of what the middle one lies beside it.
  struct Thick {
    Vec3 centre, way;
    double way_length, radius;
    explicit Thick(const Row& row) {
      const Vec3 from = place(row.first_), to = place(row.last_), half = 0.5 * (from + to);
      way = to - from, way_length = length(way);
      Vec3 beside = place(row.middle_) - half;
      if (way_length > 0) beside = beside - dot(beside, way) / dot(way, way) * way;
      centre = half + 0.5 * beside;
      radius = row.radius_ + 0.5 * length(beside);
    }
    /// The other lies beside the line through this one.
    bool is_passed_by(const Thick& other) const {
      return area(other.centre - centre, way) >
             (radius + other.radius) * way_length + 0.5 * area(other.way, way);
    }
    bool lies_apart_from(const Thick& other) const {
      return is_passed_by(other) || other.is_passed_by(*this);
    }

   private:
    static Vec3 place(const Sphere& s) { return {s.x, s.y, s.z}; }
    /// Of the parallelogram between them.
    static double area(const Vec3& a, const Vec3& b) {
      const double along = dot(a, b);
      return std::sqrt(std::max(0.0, dot(a, a) * dot(b, b) - along * along));
    }
  };

  const Sphere &first_, &middle_, &last_;
  Four low_, high_;
  float radius_;
};

double along_the_axes(const Sphere& a, const Sphere& b) {
  return std::abs(double{a.x} - b.x) + std::abs(double{a.y} - b.y) + std::abs(double{a.z} - b.z);
}

}  // namespace

RowLook RowLook::at(std::span<const Sphere> spheres, double asked) {
  constexpr std::uint32_t least = 4, few = 16, most = 12;
  const auto rows = static_cast<std::uint32_t>(spheres.size() / row_size), some = rows < few ? 2u : 4u;
  RowLook look;
  if (rows < least) return look;
  double near = 0, squares = 0;
  std::uint32_t looks = 0, taken = 0, gone = 0;
  std::array<double, most> straight;  // ascending
  const auto take = [&](std::uint32_t own) {
    const Sphere* const first = spheres.data() + own * row_size;
    double steps = 0;
    for (const std::uint32_t at : {0u, row_size / 2 - 1, row_size - 2})
      steps += along_the_axes(first[at], first[at + 1]);
    if (steps > 0) {
      const double share = 3 * along_the_axes(first[0], first[row_size - 1]) / ((row_size - 1) * steps);
      std::uint32_t at = gone++;
      for (; at > 0 && straight[at - 1] > share; --at) straight[at] = straight[at - 1];
      straight[at] = share;
    }
    const Row row(first);
    for (std::uint32_t apart = 2; apart < rows; apart *= 2) {
      // Those from `apart` to 2 apart - 1 away.
      const auto of = [&](std::uint32_t all) {
        return std::max(std::min(2 * apart, all + 1), apart) - apart;
      };
      const std::uint32_t before = of(own), behind = of(rows - 1 - own);
      if (before + behind == 0) break;
      const std::uint32_t one = scattered(++looks, before + behind);
      const std::uint32_t other = one < before ? own - apart - one : own + apart + (one - before);
      if (!row.meets(Row(spheres.data() + other * row_size))) continue;
      const double alike = before + behind;  // as this one is taken for
      near += alike, squares += alike * alike;
    }
    ++taken;
  };
  // What was seen may be chance.
  const auto clear = [&] {
    const double beyond = near - asked * taken;
    return beyond * beyond > 2 * squares;
  };
  // Not quite at even distances, which are whole strands where numbers are round.
  while (taken < some) take(sample_along(taken, some, rows));
  if (near > 0 && rows >= few)  // or nothing more will be found
    while (taken < std::min(rows, most) && !clear())
      for (std::uint32_t k = 0; k < some; ++k) take(scattered(taken, rows));
  look.near = near / taken;
  // That of the middle ones: a row that jumps would outweigh all others.
  if (gone > 0) look.straight = (straight[(gone - 1) / 2] + straight[gone / 2]) / 2;
  return look;
}

}  // namespace catena

#include "catena/core/plan/row_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "catena/core/scattered.h"
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
  explicit Row(std::span<const Sphere> of)
      : first_(of.front()), middle_(of[of.size() / 2]), last_(of.back()) {
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

/// Spheres in rows of eight, but for what of those is of another strand than the first.
class Rows {
 public:
  Rows(std::span<const Sphere> spheres, std::span<const std::uint32_t> strand_first)
      : spheres_(spheres), strand_first_(strand_first) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(spheres_.size() / row_size); }
  std::span<const Sphere> of(std::uint32_t k) const {
    const std::uint32_t i = k * row_size;
    if (strand_first_.size() <= 2) return spheres_.subspan(i, row_size);
    const auto end = std::ranges::upper_bound(strand_first_, i);
    const std::uint32_t size = std::min(row_size, *end - end[-1]);
    return spheres_.subspan(std::min(i, *end - size), size);
  }

 private:
  const std::span<const Sphere> spheres_;
  const std::span<const std::uint32_t> strand_first_;
};

double along_the_axes(const Sphere& a, const Sphere& b) {
  return std::abs(double{a.x} - b.x) + std::abs(double{a.y} - b.y) + std::abs(double{a.z} - b.z);
}

/// From the first sphere to the last, of the way along all, as three of the steps tell it; none where these
/// lead nowhere.
std::optional<double> straightness(std::span<const Sphere> row) {
  const std::size_t last = row.size() - 1;
  if (last == 0) return std::nullopt;
  double steps = 0;
  for (const std::size_t at : {std::size_t{0}, last / 2, last - 1})
    steps += along_the_axes(row[at], row[at + 1]);
  if (steps == 0) return std::nullopt;
  return 3 * along_the_axes(row.front(), row.back()) / (static_cast<double>(last) * steps);
}

}  // namespace

RowLook RowLook::at(std::span<const Sphere> spheres, double asked,
                    std::span<const std::uint32_t> strand_first) {
  constexpr std::uint32_t least = 4, few = 16, many = 64, most = 24, most_looks = 4, alike_of_a_look = 32;
  const Rows all(spheres, strand_first);
  const std::uint32_t rows = all.count(), some = rows < few ? 2u : 4u,
                      at_most = rows < many ? most / 2 : most;
  RowLook look;
  if (rows < least) return look;
  double near = 0, squares = 0;
  std::uint32_t looks = 0, taken = 0, gone = 0;
  std::array<double, most> straight;  // ascending
  const auto take = [&](std::uint32_t own) {
    const std::span<const Sphere> spheres_of_own = all.of(own);
    if (const std::optional<double> share = straightness(spheres_of_own)) {
      std::uint32_t at = gone++;
      for (; at > 0 && straight[at - 1] > *share; --at) straight[at] = straight[at - 1];
      straight[at] = *share;
    }
    const Row row(spheres_of_own);
    for (std::uint32_t apart = 2; apart < rows; apart *= 2) {
      // Those from `apart` to 2 apart - 1 away.
      const auto of = [&](std::uint32_t there) {
        return std::max(std::min(2 * apart, there + 1), apart) - apart;
      };
      const std::uint32_t before = of(own), behind = of(rows - 1 - own);
      if (before + behind == 0) break;
      const std::uint32_t looks_there =
          std::clamp((before + behind) / alike_of_a_look, std::uint32_t{1}, most_looks);
      for (std::uint32_t k = 0; k < looks_there; ++k) {
        const std::uint32_t one = scattered(++looks, before + behind);
        const std::span<const Sphere> other =
            all.of(one < before ? own - apart - one : own + apart + (one - before));
        if (!row.meets(Row(other))) continue;
        // As this one is taken for, and rows that are shorter than eight are more.
        const double shorter = double{row_size * row_size} /
                               static_cast<double>(spheres_of_own.size() * other.size()),
                     alike = shorter * (before + behind) / looks_there;
        near += alike, squares += alike * alike;
      }
    }
    ++taken;
  };
  // What was seen may be chance.
  const auto clear = [&] {
    const double beyond = near - asked * taken;
    return beyond * beyond > 3 * squares;
  };
  // Not quite at even distances, which are whole strands where numbers are round.
  while (taken < some) take(sample_along(taken, some, rows));
  if (near > 0 && rows >= few)  // or nothing more will be found
    while (taken < std::min(rows, at_most) && !clear())
      for (std::uint32_t k = 0; k < some; ++k) take(scattered(taken, rows));
  look.near = near / taken;
  // That of the middle ones: a row that jumps would outweigh all others.
  if (gone > 0) look.straight = (straight[(gone - 1) / 2] + straight[gone / 2]) / 2;
  return look;
}

}  // namespace catena

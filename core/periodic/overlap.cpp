#include "catena/core/periodic/overlap.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "catena/core/periodic/image_squares.h"

namespace catena {
namespace {

/// Of two spheres that collide the nearest image is the one that overlaps, or, where two do, the nearer of
/// them. Each edge's share of the way to it is half of the edge at most, so rounding finds it or one beside
/// it.
ImageSquares nearest_image(const Sphere& a, const Sphere& b, const PeriodicBox& box) {
  const auto way = box.in_edges({double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z});
  std::optional<ImageSquares> nearest;
  const auto beside = [&](std::size_t edge) { return box.length[edge] > 0 ? 1 : 0; };
  const auto whole = [&](std::size_t edge, int step) {
    return step - static_cast<std::int32_t>(std::round(way[edge]));
  };
  for (int x = -beside(0); x <= beside(0); ++x)
    for (int y = -beside(1); y <= beside(1); ++y)
      for (int z = -beside(2); z <= beside(2); ++z) {
        const Shift shift{whole(0, x), whole(1, y), whole(2, z)};
        if (!image_overlaps(a, b, shift, box)) continue;
        const ImageSquares image(a, b, shift, box);
        if (!nearest || image.distance < nearest->distance) nearest = image;
      }
  if (!nearest) throw std::logic_error("overlap_of: the spheres do not collide in this box");
  return *nearest;
}

/// A number's first 106 digits, the second part below the last digit of the first. Of these a result is the
/// same to its last digit on every machine; long double has 53 digits on some, 64 or 113 on others.
struct Digits {
  double high, low;
};

/// The first 53 digits, and takes them off the number.
double cut(ImageSquares::Integer& whole) {
  constexpr unsigned digits = std::numeric_limits<double>::digits;
  if (whole == 0) return 0;
  const unsigned have = msb(whole) + 1, below = have > digits ? have - digits : 0;
  const auto first = static_cast<std::uint64_t>(whole >> below);
  whole -= ImageSquares::Integer(first) << below;
  return std::ldexp(static_cast<double>(first), static_cast<int>(below));
}

Digits digits_of(ImageSquares::Integer whole) {
  const double high = cut(whole);
  return {high, cut(whole)};
}

Digits root(Digits of) {
  if (of.high == 0) return {0, 0};
  const double high = std::sqrt(of.high);
  return {high, (std::fma(-high, high, of.high) + of.low) / (2 * high)};
}

/// Of two that are not negative.
Digits sum(Digits a, Digits b) {
  if (a.high < b.high) std::swap(a, b);
  const double high = a.high + b.high;
  return {high, b.high - (high - a.high) + (a.low + b.low)};
}

double quotient(Digits of, Digits by) {
  const double first = of.high / by.high;
  if (std::isinf(first)) return first;
  return first + (std::fma(-first, by.high, of.high) + (of.low - first * by.low)) / by.high;
}

}  // namespace

Overlap overlap_of(const Sphere& a, const Sphere& b, const PeriodicBox* box) {
  const ImageSquares image = box ? nearest_image(a, b, *box) : ImageSquares(a, b, {}, {});
  const ImageSquares::Integer touch = image.reach * image.reach, gap = touch - image.distance;
  if (gap == 0) return {0, 0};
  const Digits apart = digits_of(abs(gap));
  // ri + rj - d = (t - q) / (ri + rj + d): the difference is taken before anything is rounded.
  const double depth = quotient(apart, sum(digits_of(image.reach), root(digits_of(image.distance))));
  return {std::ldexp(gap < 0 ? -depth : depth, ImageSquares::unit), quotient(apart, digits_of(touch))};
}

}  // namespace catena

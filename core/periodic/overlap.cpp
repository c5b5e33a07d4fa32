#include "catena/core/periodic/overlap.h"

#include <cmath>
#include <optional>
#include <stdexcept>

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

long double rounded(const ImageSquares::Integer& whole) { return static_cast<long double>(whole); }

}  // namespace

Overlap overlap_of(const Sphere& a, const Sphere& b, const PeriodicBox* box) {
  const ImageSquares image = box ? nearest_image(a, b, *box) : ImageSquares(a, b, {}, {});
  const ImageSquares::Integer touch = image.reach * image.reach, gap = touch - image.distance;
  if (gap == 0) return {0, 0};
  // ri + rj - d = (t - q) / (ri + rj + d): the difference is taken before anything is rounded.
  const long double depth = rounded(gap) / (rounded(image.reach) + std::sqrt(rounded(image.distance)));
  return {static_cast<double>(std::ldexp(depth, ImageSquares::unit)),
          static_cast<double>(std::abs(rounded(gap)) / rounded(touch))};
}

}  // namespace catena

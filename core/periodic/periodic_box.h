#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "catena/core/sphere.h"

namespace catena {

/// A box that repeats itself in space: edges a = (length[0], 0, 0), b = (xy, length[1], 0) and c = (xz, yz,
/// length[2]). A length of 0: it does not repeat along that edge. Every number is binary64, as a user writes
/// it, and is exact from there on. Where it begins does not matter.
struct PeriodicBox {
  std::array<double, 3> length{};
  double xy = 0, xz = 0, yz = 0;
  friend bool operator==(const PeriodicBox&, const PeriodicBox&) = default;

  /// Along one edge at least. A file's box that does not says that nothing repeats.
  bool repeats() const { return length != std::array<double, 3>{}; }

  /// The three coordinates of whole multiples of the edges, rounded.
  std::array<double, 3> along(const std::array<double, 3>& edges) const {
    return {edges[0] * length[0] + edges[1] * xy + edges[2] * xz, edges[1] * length[1] + edges[2] * yz,
            edges[2] * length[2]};
  }

  /// A point in edges of the box, rounded; 0 along an edge that does not repeat.
  std::array<double, 3> in_edges(const std::array<double, 3>& point) const {
    const auto share = [](double value, double edge) { return edge > 0 ? value / edge : 0; };
    const double c = share(point[2], length[2]), b = share(point[1] - c * yz, length[1]);
    return {share(point[0] - b * xy - c * xz, length[0]), b, c};
  }

  /// The whole edges that are nearest to a way, edge by edge.
  std::array<double, 3> whole_edges(const std::array<double, 3>& way) const {
    const auto edges = in_edges(way);
    return {std::round(edges[0]), std::round(edges[1]), std::round(edges[2])};
  }
  /// The way to the image of a point that is nearest edge by edge, from the way to the point; rounded.
  std::array<double, 3> to_nearest(const std::array<double, 3>& way) const {
    const auto whole = along(whole_edges(way));
    return {way[0] - whole[0], way[1] - whole[1], way[2] - whole[2]};
  }

  /// How far apart the box's opposite faces are, rounded; 0 for those that do not repeat.
  std::array<double, 3> widths() const;
};

/// Whole edges of a box: which image of a sphere is meant.
using Shift = std::array<std::int32_t, 3>;

/// Whether a overlaps or touches the image of b: |a - (b + shift * edges)|^2 <= (ra + rb)^2 in exact real
/// arithmetic on the stored binary32 spheres and the binary64 box, no matter whether the image's centre is a
/// number in binary32. The box is one that check_box accepts, |shift| <= 2^22. Decided in binary64 where its
/// error bound allows, otherwise by integers.
bool image_overlaps(const Sphere& a, const Sphere& b, const Shift& shift, const PeriodicBox& box);

/// The same by integers alone; what the bound is tested against.
bool image_overlaps_by_integers(const Sphere& a, const Sphere& b, const Shift& shift, const PeriodicBox& box);

/// Throws InputError unless every number is 0 or between 2^-100 and 2^100 in magnitude, no length is
/// negative, one at least is not 0, no tilt is above 32 times the length along which it goes, where that
/// repeats (so that rounding leaves where a sphere is within a box to 1e-6 of it, up to 2^20 boxes away), and
/// each width is at least twice the reach, the largest sum of two radii: otherwise which image is the nearest
/// would not be plain.
void check_box(const PeriodicBox& box, double reach);

/// X,Y,Z, and ,XY,XZ,YZ where it is tilted: as --box takes it. Reads back as it is.
std::string written(const PeriodicBox& box);

/// The box of that frame among those of an input, one a frame, one for all, or none: then null.
const PeriodicBox* box_of(std::span<const PeriodicBox> boxes, std::uint32_t frame);

}  // namespace catena

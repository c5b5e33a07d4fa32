#include "catena/core/periodic/periodic_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/periodic/image_squares.h"

namespace catena {
namespace {

using Integer = ImageSquares::Integer;

Integer units(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const Integer digits = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int shift = exponent - 53 - ImageSquares::unit;
  return shift >= 0 ? Integer(digits << shift) : Integer(digits >> -shift);  // what is shifted out is 0
}

}  // namespace

std::array<double, 3> PeriodicBox::widths() const {
  const double tilt = length[0] > 0 && length[1] > 0 ? xy / length[1] : 0;
  const double lean_y = length[1] > 0 && length[2] > 0 ? yz / length[2] : 0;
  const double lean_x = length[0] > 0 && length[2] > 0 ? (xz - tilt * yz) / length[2] : 0;
  return {length[0] / std::sqrt(1 + tilt * tilt + lean_x * lean_x),
          length[1] / std::sqrt(1 + lean_y * lean_y), length[2]};
}

ImageSquares::ImageSquares(const Sphere& a, const Sphere& b, const Shift& shift, const PeriodicBox& box) {
  const Integer dx = units(b.x) - units(a.x) + shift[0] * units(box.length[0]) + shift[1] * units(box.xy) +
                     shift[2] * units(box.xz);
  const Integer dy = units(b.y) - units(a.y) + shift[1] * units(box.length[1]) + shift[2] * units(box.yz);
  const Integer dz = units(b.z) - units(a.z) + shift[2] * units(box.length[2]);
  distance = dx * dx + dy * dy + dz * dz;
  reach = units(a.radius) + units(b.radius);
}

bool image_overlaps_by_integers(const Sphere& a, const Sphere& b, const Shift& shift,
                                const PeriodicBox& box) {
  const ImageSquares exact(a, b, shift, box);
  return exact.distance <= exact.reach * exact.reach;
}

bool image_overlaps(const Sphere& a, const Sphere& b, const Shift& shift, const PeriodicBox& box) {
  const auto moved = box.along({double(shift[0]), double(shift[1]), double(shift[2])});
  const double dx = (double{b.x} - a.x) + moved[0], dy = (double{b.y} - a.y) + moved[1],
               dz = (double{b.z} - a.z) + moved[2];
  const double reach = double{a.radius} + b.radius;
  // Each difference is a sum of at most five terms, none larger than `most`: its error is below 16 units in
  // the last place of that, 2^-49 of it with room to spare. The rest is as in reference/exact_gap.h.
  const double most =
      std::max({std::abs(double{a.x}), std::abs(double{a.y}), std::abs(double{a.z}), std::abs(double{b.x}),
                std::abs(double{b.y}), std::abs(double{b.z}), std::abs(shift[0] * box.length[0]),
                std::abs(shift[1] * box.length[1]), std::abs(shift[2] * box.length[2]),
                std::abs(shift[1] * box.xy), std::abs(shift[2] * box.xz), std::abs(shift[2] * box.yz)});
  const double error = 0x1p-48 * most;
  const double q = dx * dx + dy * dy + dz * dz, t = reach * reach;
  const double doubt =
      2 * error * (std::abs(dx) + std::abs(dy) + std::abs(dz)) + 4 * error * error + 0x1p-49 * (q + t);
  if (std::abs(q - t) > doubt) return q < t;
  return image_overlaps_by_integers(a, b, shift, box);
}

void check_box(const PeriodicBox& box, double reach) {
  constexpr double least_size = 0x1p-100, greatest_size = 0x1p100;
  for (const double number : {box.length[0], box.length[1], box.length[2], box.xy, box.xz, box.yz})
    if (!std::isfinite(number) ||
        (number != 0 && (std::abs(number) < least_size || std::abs(number) > greatest_size)))
      throw InputError(
          fmt::format("the box has {} where a length or a tilt is due, which is 0 or of a size from {} to "
                      "{}; take other units",
                      number, least_size, greatest_size));
  const auto [least, greatest] = std::minmax_element(box.length.begin(), box.length.end());
  if (*least < 0 || *greatest == 0)
    throw InputError("the box needs lengths above 0, or 0 along an edge that does not repeat");
  for (const auto& [tilt, edge] : {std::pair(box.xy, 0), std::pair(box.xz, 0), std::pair(box.yz, 1)})
    if (const double length = box.length[edge]; length > 0 && std::abs(tilt) > 32 * length)
      throw InputError(
          fmt::format("the box is tilted by {} along {}, more than 32 times its length {} there; take whole "
                      "lengths off the tilt, which leaves the box the same",
                      tilt, "xyz"[edge], length));
  const auto widths = box.widths();
  for (std::size_t edge = 0; edge < 3; ++edge)
    if (box.length[edge] > 0 && widths[edge] < 2 * reach)
      throw InputError(
          fmt::format("the box is {} wide along {}, less than twice the reach {} of two spheres, so the "
                      "nearest image is not plain; take smaller radii or a larger box",
                      widths[edge], "xyz"[edge], reach));
}

std::string written(const PeriodicBox& box) {
  const auto [x, y, z] = box.length;
  const bool tilted = box.xy != 0 || box.xz != 0 || box.yz != 0;
  return fmt::format("{},{},{}", x, y, z) + (tilted ? fmt::format(",{},{},{}", box.xy, box.xz, box.yz) : "");
}

const PeriodicBox* box_of(std::span<const PeriodicBox> boxes, std::uint32_t frame) {
  if (boxes.empty()) return nullptr;
  return &boxes[frame < boxes.size() ? frame : 0];
}

}  // namespace catena

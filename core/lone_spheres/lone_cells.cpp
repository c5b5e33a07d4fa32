#include "catena/core/lone_spheres/lone_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace catena {

std::optional<LoneCells> LoneCells::of(const Extent& extent, std::uint32_t spheres) {
  constexpr std::uint32_t bits_of_a_sphere = 32;
  const double sum = 2.0 * extent.greatest_radius;
  // Radii that are next to nothing, points perhaps, leave the width to choose: so that few cells have one.
  const double even = extent.sides / 3 / std::cbrt(double{bits_of_a_sphere} * spheres);
  constexpr double next_to_nothing = 0x1p-12;
  double width = sum / greatest_sum;
  if (width < next_to_nothing * even) width = even;
  // Some more, for what is rounded here.
  width = std::max(width, double{extent.greatest_coordinate} / most_cells) * (1 + 0x1p-20);
  LoneCells cells{};
  cells.cells_per_unit = static_cast<float>(1 / width);
  if (!std::isnormal(cells.cells_per_unit)) return std::nullopt;
  cells.reach = static_cast<float>(sum * cells.cells_per_unit) * (1 + 0x1p-20f) + rounding_slack;
  return cells.of_bits(std::uint64_t{bits_of_a_sphere} * spheres);
}

LoneCells LoneCells::of_bits(std::uint64_t at_least) const {
  constexpr std::uint64_t fewest = 1u << 15, most = 1u << 31;
  LoneCells cells = *this;
  cells.bits = static_cast<std::uint32_t>(std::bit_ceil(std::clamp(at_least, fewest, most)));
  // As in BucketMap: of all lattices nearly the most even. Odd, so that no axis has a shorter period.
  cells.row = static_cast<std::uint32_t>(0.75487766624669276 * cells.bits) | 1;
  cells.layer = static_cast<std::uint32_t>(0.56984029099805327 * cells.bits) | 1;
  return cells;
}

}  // namespace catena

#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "catena/core/grid/bucket_map.h"
#include "catena/core/host_device.h"

namespace catena {

/// Where a coordinate lies along one axis: its cell, and at least how far, in cells, the cells below and
/// above begin. Too little by up to 2^-22 of rounding, or 0 where the cell is far, and numbered by a hash.
struct AxisCell {
  double cell;
  float below, above;

  CATENA_HD static AxisCell of(float coordinate, double cells_per_unit) {
    const double at = coordinate * cells_per_unit;
    if (std::fabs(at) < BucketMap::far_cell) {
      const double cell = std::floor(at);
      return {cell, static_cast<float>(at - cell), static_cast<float>(1 - (at - cell))};
    }
    std::uint32_t bits;
    std::memcpy(&bits, &coordinate, sizeof bits);
    return {static_cast<double>(bits * 0x9E3779B1u >> 7), 0, 0};
  }
};

/// The cell of a point.
struct PointCell {
  AxisCell x, y, z;

  template <class Point>
  CATENA_HD static PointCell of(const Point& p, double cells_per_unit) {
    return {AxisCell::of(p.x, cells_per_unit), AxisCell::of(p.y, cells_per_unit),
            AxisCell::of(p.z, cells_per_unit)};
  }
};

/// A BucketMap that wraps, for one bucket at a time, on the host and in kernels. Several levels of cells
/// share the buckets; who looks into one level's cells passes over what is of another.
struct CellTable {
  double row, layer, inverse;
  std::uint32_t buckets;
  std::uint32_t step[9];  ///< from a bucket to that of the cell y rows and z layers on, at y + 1 + 3 (z + 1)

  /// For about `count` points in any part of space; at least 512 buckets.
  static CellTable of(std::uint32_t count) {
    return from(map_buckets(1, {{-1e9f, -1e9f, -1e9f}, {1e9f, 1e9f, 1e9f}}, count / 2));
  }

  /// Laid out so that cells which are near in space are near in memory, when there is room for a cube of so
  /// many cells a side; rows are of an odd length, for memory in banks. A box of other sides and the same sum
  /// of them meets itself a few times at most; so do finer cells, as often as there are more of them. With
  /// one level of cells there are no more buckets than the cube has cells.
  CellTable compact(double side, bool one_level) const {
    const auto odd = [](double at_most) { return 2 * std::floor((at_most - 1) / 2) + 1; };
    const double most = odd(std::cbrt(static_cast<double>(buckets)));
    if (!(side + 2 <= most)) return *this;
    BucketMap map{0, one_level ? odd(side + 3) : most, 0, 0, buckets, true};
    map.layer = map.row * map.row;
    if (one_level) map.buckets = std::max(512u, static_cast<std::uint32_t>(map.row * map.layer));
    return different_steps(map) ? from(map) : *this;
  }

  /// Levels begin `level_step` buckets after one another: cells of the same numbers seldom meet.
  CATENA_HD std::uint32_t bucket(const PointCell& at, std::uint32_t level) const {
    return bucket(at.x.cell, at.y.cell, at.z.cell, level);
  }
  CATENA_HD std::uint32_t bucket(double x, double y, double z, std::uint32_t level) const {
    constexpr double level_step = 1543;
    double b = z * layer + (y * row + (x + level * level_step));
    b -= std::floor(b * inverse) * buckets;  // the quotient may be one off
    if (b < 0) b += buckets;
    if (b >= buckets) b -= buckets;
    return static_cast<std::uint32_t>(b);
  }
  /// The bucket `steps` < buckets on.
  CATENA_HD std::uint32_t on(std::uint32_t bucket, std::uint32_t steps) const {
    const std::uint32_t to = bucket + steps;
    return to >= buckets ? to - buckets : to;
  }
  CATENA_HD std::uint32_t before(std::uint32_t bucket) const {
    return bucket == 0 ? buckets - 1 : bucket - 1;
  }

 private:
  static CellTable from(const BucketMap& map) {
    CellTable table{map.row, map.layer, 1.0 / map.buckets, map.buckets, {}};
    for (int k = 0; k < 9; ++k) table.step[k] = map.step(k % 3 - 1, k / 3 - 1);
    return table;
  }
};

}  // namespace catena

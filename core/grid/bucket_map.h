#pragma once
#include <array>
#include <cstdint>

#include "catena/core/export.h"

namespace catena {

/// Which bucket a point of space belongs to. Space is cut into cubes, the *cells*; cell (x, y, z) belongs to
/// bucket (x + row y + layer z - origin) mod buckets. It is linear, so what lies around a cell lies at the
/// same steps from its bucket, whatever the cell: three cells along x are three buckets in a row, and no list
/// of cells is needed. All steps of at most 2 along x and 1 along y and z lead to different buckets
/// (different_steps), so no pair of spheres is met twice. Cells that share a bucket by chance cost
/// comparisons, and nothing else.
///
/// Where the box of all spheres has few cells, it is laid out row by row, and no two of its cells share a
/// bucket. Elsewhere `buckets` is prime and row and layer are parts of it that whole numbers approximate
/// badly: lines and planes of cells spread as evenly as space does.
///
/// Why spheres of radii at most r whose distance is at most 2 r have cells that differ by at most 1 in each
/// coordinate: a coordinate v is that of cell floor(v * cells_per_unit), in binary64; 2 r cells_per_unit <= 1
/// - cell_slack / 2. Below far_cell a product is wrong by at most 2^-28, and two such differ by less than 1:
/// properties/proofs/grid_cells.g. From far_cell on, binary32 numbers lie more than a cell apart, so only
/// equal coordinates are within reach; their cells are numbered by a hash of their bits, the same for equal
/// ones. And a number before far_cell is not within reach of one behind it.
struct CATENA_API BucketMap {
  static constexpr double cell_slack = 0x1p-16;
  static constexpr double far_cell = 0x1p25;
  /// All numbers up to (1 + row + layer) far_cell are exact in binary64.
  static constexpr std::uint32_t most_buckets = std::uint32_t{1} << 26;

  double cells_per_unit;
  double row, layer, origin;
  std::uint32_t buckets;
  bool wraps;  ///< else no bucket needs to be brought into range

  /// How far the bucket of the cell `y` rows and `z` layers on lies, before the first or after the last at
  /// most.
  std::uint32_t step(int y, int z) const;
};

/// The box of all centres.
struct CATENA_API CentreBox {
  std::array<float, 3> low, high;
};

/// The cells for spheres of radius <= r, `count` of them, all in the box, in at most about 2 count buckets.
CATENA_API BucketMap map_buckets(float r, const CentreBox& box, std::uint32_t count);

/// The step, forwards, to the bucket before the one that lies y rows and z layers on.
CATENA_API std::uint32_t step_before(const BucketMap& map, int y, int z);

/// True when all steps of at most 2 along x, and 1 along y and z, lead to different buckets.
CATENA_API bool different_steps(const BucketMap& map);

}  // namespace catena

#pragma once
#include <cstdint>

#include "catena/core/cells/cell_table.h"
#include "catena/core/cells/counter.h"
#include "catena/core/cells/octave.h"
#include "catena/core/chain/chain_view.h"

namespace catena {

/// Spheres of a chain sorted into hashed cells, in a handful of steps without a look at the host between
/// them: plain pointers, valid in one memory space. An octave of radii is a *level*, with cells as wide as
/// two of its greatest spheres, so that what overlaps a sphere of this or a finer octave lies in the 27 cells
/// around it (BucketMap). All levels share one table of buckets. Spheres of a bucket lie side by side at
/// *places*; buckets follow one another within a chunk, and chunks lie in any order.
struct SphereCells {
  static constexpr std::uint32_t chunk = 1024;  ///< buckets
  static constexpr std::uint32_t least_log2 = 12, tables = 15;

  /// What is known once the steps before are done.
  struct State {
    std::uint32_t places;  ///< spheres that were sorted
    std::uint32_t
        levels[Octaves::count / 32];  ///< bit k: there are spheres of octave k; not kept for one octave
  };

  CellTable table[tables];  ///< for 2^12, 2^13, ... 2^26 spheres
  double cells_per_unit;    ///< of octave 0
  Octaves octaves;
  std::uint32_t *count, *start;  ///< spheres of each bucket, all 0 between builds; see starts()
  std::uint32_t* rank;           ///< by sphere: how many came into its bucket before
  std::uint32_t* index;          ///< by place: which sphere
  Sphere* sphere;                ///< by place
  State* state;

  /// The arithmetic of the cells, for a chain of that extent; memory is the caller's to give.
  static SphereCells of(const Extent& extent) {
    static const SphereCells all_sizes = [] {
      SphereCells cells{};
      for (std::uint32_t k = 0; k < tables; ++k) cells.table[k] = CellTable::of(1u << (least_log2 + k));
      return cells;
    }();
    SphereCells cells = all_sizes;
    const double greatest = extent.greatest_radius;
    // As map_buckets: points overlap where they are equal, and 2^149 makes all different numbers different
    // cells.
    cells.cells_per_unit = greatest > 0 ? (1 - BucketMap::cell_slack) / (2 * greatest) : 0x1p149;
    cells.octaves = {greatest, 2.0 * extent.least_radius > greatest || greatest == 0};
    for (CellTable& table : cells.table) table = table.compact(extent.sides * cells.cells_per_unit / 3);
    return cells;
  }

  /// The table for so many spheres.
  CATENA_HD const CellTable& table_for(std::uint32_t spheres) const {
    std::uint32_t k = 0;
    while (k + 1 < tables && (1u << (least_log2 + k)) < spheres) ++k;
    return table[k];
  }
  /// Rounded up to whole chunks: how many buckets `count` must have room for.
  CATENA_HD static std::uint32_t chunks(const CellTable& table) {
    return (table.buckets + chunk - 1) / chunk;
  }
  /// Where a chunk's part of `start` begins: one more entry than it has buckets, the end of the last.
  CATENA_HD static std::uint32_t starts(std::uint32_t chunk_number) { return chunk_number * (chunk + 1); }
  CATENA_HD static std::uint32_t start_of(std::uint32_t bucket) { return bucket + bucket / chunk; }

  /// How far, in cells of an octave, the sphere lies at most from one of that octave that it overlaps.
  CATENA_HD float reach(const Sphere& s, std::uint32_t octave) const {
    return static_cast<float>(s.radius * (cells_per_unit * Octaves::cells_of(octave)) + 0.5);
  }
  CATENA_HD PointCell cell(const Sphere& s, std::uint32_t octave) const {
    return PointCell::of(s, cells_per_unit * Octaves::cells_of(octave));
  }

  /// Step 1, for each sphere. Returns its octave, which belongs to state->levels.
  CATENA_HD std::uint32_t enter(const CellTable& in, const Sphere& s, std::uint32_t i) const {
    const std::uint32_t octave = octaves.of(s.radius);
    rank[i] = fetch_add(count + in.bucket(cell(s, octave), octave), 1);
    return octave;
  }
  // Step 2, for each chunk: counts become starts, and 0 again.
  /// Step 3, for each sphere.
  CATENA_HD void place(const CellTable& in, const Sphere& s, std::uint32_t i) const {
    index[place_of(in, s, i)] = i;
  }
  CATENA_HD std::uint32_t place_of(const CellTable& in, const Sphere& s, std::uint32_t i) const {
    const std::uint32_t octave = octaves.of(s.radius);
    return start[start_of(in.bucket(cell(s, octave), octave))] + rank[i];
  }
  /// Step 4, for each place: writes side by side what lies apart, which is faster than to write it apart.
  CATENA_HD void fill(const ChainView& chain, std::uint32_t place) const {
    sphere[place] = chain.spheres[index[place]];
  }
};

}  // namespace catena

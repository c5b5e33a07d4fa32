#pragma once
#include <algorithm>
#include <cstdint>

#include "catena/core/blocks/beyond_cache.h"
#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/grid/sphere_grid.h"
#include "catena/core/space_tree/mean_near.h"
#include "catena/core/space_tree/space_order.h"

namespace catena {

/// What a search of a SpaceTree costs, about, on one core with AVX-512. Measured on chains of many kinds; a
/// wrong figure costs time and changes no answer.
struct SpaceCost {
  static constexpr double node_ns = 40, entry_ns = 8, near_ns = 24;
  static constexpr double build_ns = 80;     ///< a block
  static constexpr double near_share = 0.6;  ///< of all that is not the build, where much is near
  static constexpr double row_ns = 1;  ///< a sphere and those of eight that it overlaps, if there are any
  std::uint64_t nodes = 0;             ///< pairs of nodes that were opened
  std::uint64_t entries = 0;           ///< pairs of entries whose boxes met
  std::uint64_t near = 0;              ///< those whose capsules may meet too

  /// Where so many pairs of spheres overlap.
  double ns(double pairs) const {
    return node_ns * static_cast<double>(nodes) + entry_ns * static_cast<double>(entries) +
           near_ns * static_cast<double>(near) + row_ns * rows(static_cast<double>(near), pairs);
  }
  /// Each a row of its own, until all rows have some.
  static double rows(double near, double pairs) { return std::min(BlockTree::block * near, pairs); }
  /// Pairs of blocks that are near which take so long.
  static double near_in(double ns, double pairs) {
    const double all_rows = ns / (near_ns + BlockTree::block * row_ns);
    return std::max(all_rows, (ns - row_ns * pairs) / near_ns);
  }
};

/// What it costs, about, to search one of so many spheres by itself, likewise, where so many are near it as
/// NearSpheres tells.
struct SingleSphereCost {
  /// In nanoseconds, by cells of the better width.
  static double in_cells(double near, std::uint32_t spheres) {
    return std::min(in_wide_cells(near, spheres), in_narrow_cells(near)) + 6 * octaves_beyond_cache(spheres);
  }
  static bool wide_cells(double near, std::uint32_t spheres) {
    return in_wide_cells(near, spheres) < in_narrow_cells(near);
  }
  /// Each that is near is a pair of its own, and looked up: by AVX-512 at once, else one by one.
  CATENA_API static double in_wide_cells(double near, std::uint32_t spheres);
  /// A sphere alone in its cell pays for it and for the look at its neighbours. Where very many are near, a
  /// vector of them is not the last.
  CATENA_API static double in_narrow_cells(double near);
  /// So much less where the order of an earlier frame serves: more than it takes to sort, as the price below
  /// is that of the dearest of a kind, and then the cheaper ones are all worth it.
  static constexpr double kept_order_ns = 24;
  /// Spheres are sorted by size: each bit that tells their octaves is as many more classes to look into,
  /// where much is in cells for the greatest that is not within reach of the others.
  /// Vectors narrower than AVX-512's cost it more than cells.
  CATENA_API static double in_space(const NearSpheres& near, double octave_bits, std::uint32_t spheres);
  /// So many that are near and less than half as great find room in the cells of the greater ones: where one
  /// is there are about three times as many as around it.
  static bool one_width(double near) { return 3 * near <= 27.0 / 2 * SphereGrid::most_in_a_cell; }
};

/// How spheres are searched one by one, what that costs each, and how many pairs that overlap there are for
/// each, about.
struct SingleSpheres {
  bool in_cells;
  double ns, pairs;
  float greatest_radius = 0;  ///< but for a few
  bool wide = false;          ///< cells are: see SphereGrid
};
/// Those in crowded nodes, by a look at some. Cells are for radii that come in one octave, as one in 128
/// tells, or where the smaller ones are few in cells for the greater.
CATENA_API SingleSpheres single_spheres(const ChainView& chain, const BlockTree& tree,
                                        const Crowding& crowding, SpaceSort sort = SpaceSort::anew);
/// The same of all spheres of a chain, where there is no tree.
CATENA_API SingleSpheres single_spheres(const ChainView& chain, SpaceSort sort = SpaceSort::anew);
/// Whether wide cells are for all spheres of a chain, by a look that costs next to nothing.
CATENA_API bool wide_cells(const ChainView& chain);

}  // namespace catena

#pragma once
#include <cstdint>
#include <cstring>

#include "catena/core/cells/buckets.h"
#include "catena/core/cells/level_box.h"
#include "catena/core/cells/level_map.h"
#include "catena/core/cells/octave.h"
#include "catena/core/chain/chain_view.h"

namespace catena {

/// Spheres of a chain sorted into hashed cells, in a handful of steps without a look at the host between
/// them: plain pointers, valid in one memory space. Cells of a *level* are as wide as two of its greatest
/// spheres, so that what overlaps a sphere of this or a finer level lies in the 27 cells around it
/// (BucketMap). All levels share one table of buckets.
///
/// At first all spheres are of level 0, whatever their radii: each then looks into one level. Where small
/// ones crowd its cells, `many_together`, they are sorted anew, an octave of radii a level.
struct SphereCells {
  static constexpr std::uint32_t least_log2 = 12, tables = 15;
  static constexpr std::uint32_t at_once = 4;  ///< so many places are read together, also behind the last one

  /// What is known once the steps before are done; 0 before step 2.
  struct State {
    std::uint32_t places[2];   ///< spheres that were sorted: in one level, and by octaves
    std::uint32_t by_octaves;  ///< not 0: they were
    std::uint32_t in_bins;     ///< not 0: in one level they were sorted by bins, and have their places
    float together;            ///< sum of the squares of all buckets' numbers of spheres, in one level
    std::uint32_t in_crowds;   ///< spheres in buckets with Buckets::crowd or more, in one level, without bins
    std::uint32_t levels[Octaves::count / 32];  ///< bit k: there are spheres of octave k
    LevelBox box[Octaves::count];               ///< around these
  };
  static constexpr float most_together = 12;  ///< others in a sphere's cell, on average; yarns have 3

  CellTable table[tables];  ///< for 2^12, 2^13, ... 2^26 spheres
  double cells_per_unit;    ///< of octave 0
  Octaves octaves;
  Buckets buckets;
  std::uint32_t* index;  ///< by place: which sphere; not kept for equal radii
  Sphere* sphere;  ///< by place, and at_once - 1 more; of equal radii with its index in place of the radius
  LevelMap map;    ///< by octaves; none where all radii are in one
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
    cells.octaves = {greatest, 2.0 * extent.least_radius > greatest || greatest == 0,
                     extent.least_radius == extent.greatest_radius};
    for (CellTable& table : cells.table)
      table = table.compact(extent.sides * cells.cells_per_unit / 3, cells.octaves.one);
    // Memory is taken for the table of all spheres: that of fewer, which the box just does not fit, has no
    // more.
    for (std::uint32_t k = tables - 1; k-- > 0;)
      if (cells.table[k].buckets > cells.table[k + 1].buckets) cells.table[k] = cells.table[k + 1];
    return cells;
  }

  /// The table for so many spheres.
  CATENA_HD const CellTable& table_for(std::uint32_t spheres) const {
    std::uint32_t k = 0;
    while (k + 1 < tables && (1u << (least_log2 + k)) < spheres) ++k;
    return table[k];
  }
  /// How far, in cells of an octave, the sphere lies at most from one of that octave that it overlaps.
  CATENA_HD float reach(const Sphere& s, std::uint32_t octave) const {
    return static_cast<float>(s.radius * (cells_per_unit * Octaves::cells_of(octave)) + 0.5);
  }
  CATENA_HD PointCell cell(const Sphere& s, std::uint32_t octave) const {
    return PointCell::of(s, cells_per_unit * Octaves::cells_of(octave));
  }

  CATENA_HD bool one_level() const { return octaves.one || state->by_octaves == 0; }
  CATENA_HD std::uint32_t places() const { return state->places[one_level() ? 0 : 1]; }
  CATENA_HD bool many_together() const {
    return state->together > most_together * static_cast<float>(state->places[0]);
  }

  /// Few spheres are in crowds, and few are outside: who looks into a crowd has work long after all others
  /// are done, unless it is shared out. Where there are more others, it is done while they are.
  CATENA_HD bool uneven() const {
    constexpr std::uint32_t few = 1u << 17;
    return state->in_crowds > 0 && state->in_crowds <= state->places[0] / 8 && state->places[0] <= few;
  }

  CATENA_HD std::uint32_t bucket_of(const CellTable& in, const Sphere& s, std::uint32_t level) const {
    return in.bucket(cell(s, level), level);
  }
  /// Step 1, for each sphere.
  CATENA_HD void enter(const CellTable& in, const Sphere& s, std::uint32_t i) const {
    buckets.enter(bucket_of(in, s, 0), i);
  }
  /// The same by octaves: its octave then belongs to state->levels, and the sphere in that octave's box.
  CATENA_HD void enter_octave(const CellTable& in, const Sphere& s, std::uint32_t i,
                              std::uint32_t octave) const {
    const PointCell at = cell(s, octave);
    buckets.enter(in.bucket(at, octave), i);
    map.mark(at, octave);
  }
  // Step 2 is that of the buckets.
  /// Step 3, for each sphere.
  CATENA_HD void place(const CellTable& in, const Sphere& s, std::uint32_t i) const {
    put(s, i, place_of(in, s, i));
  }
  CATENA_HD void put(const Sphere& s, std::uint32_t i, std::uint32_t at) const {
    put({sphere, index}, s, i, at);
  }
  /// The same in other memory, to be copied here later.
  struct Memory {
    Sphere* sphere;
    std::uint32_t* index;
  };
  CATENA_HD void put(const Memory& to, const Sphere& s, std::uint32_t i, std::uint32_t at) const {
    if (octaves.equal) {
      Sphere with_index = s;
      std::memcpy(&with_index.radius, &i, sizeof i);
      to.sphere[at] = with_index;
    } else {
      to.index[at] = i;
      to.sphere[at] = s;
    }
  }
  CATENA_HD std::uint32_t place_of(const CellTable& in, const Sphere& s, std::uint32_t i) const {
    const std::uint32_t level = one_level() ? 0 : octaves.of(s.radius);
    return buckets.place(bucket_of(in, s, level), i);
  }
};

/// A sphere, and which of the chain it is.
struct PlacedSphere {
  Sphere sphere;
  std::uint32_t index;
};

/// What lies at the places of a SphereCells, of a chain whose radii are equal or not.
template <bool equal>
class PlacedSpheres {
 public:
  CATENA_HD explicit PlacedSpheres(const SphereCells& cells)
      : cells_(cells), radius_(static_cast<float>(cells.octaves.greatest)) {}

  CATENA_HD PlacedSphere at(std::uint32_t place) const {
    const Sphere stored = cells_.sphere[place];
    return {sphere(stored), equal ? index_in(stored) : cells_.index[place]};
  }
  CATENA_HD Sphere sphere(std::uint32_t place) const { return sphere(cells_.sphere[place]); }
  /// Of what is stored at a place.
  CATENA_HD Sphere sphere(const Sphere& stored) const {
    Sphere s = stored;
    if (equal) s.radius = radius_;
    return s;
  }
  CATENA_HD std::uint32_t index(std::uint32_t place) const {
    return equal ? index_in(cells_.sphere[place]) : cells_.index[place];
  }

 private:
  CATENA_HD static std::uint32_t index_in(const Sphere& stored) {
    std::uint32_t i;
    std::memcpy(&i, &stored.radius, sizeof i);
    return i;
  }

  const SphereCells& cells_;
  const float radius_;  ///< where all are equal
};

}  // namespace catena

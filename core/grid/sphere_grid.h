#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/grid/bucket_map.h"

namespace catena {

/// The spheres of a chain sorted into the buckets of cells. Spheres of similar radius make a *level*, coarse
/// ones first: the cells of a level are as wide as two of its greatest radius, so what overlaps a sphere of
/// this or a finer level lies in the 27 cells around it. The fields of the spheres stand in the order of
/// levels and buckets; a place in that order is a *place*. 28 bytes a sphere, 8 more where radii differ by
/// more than a factor of 2.
struct SphereGrid {
  struct Level {
    BucketMap map;
    std::array<std::uint32_t, 9> rows;  ///< steps to the buckets before each of the nine rows of three around
    std::array<std::uint32_t, 4> half;  ///< and of the four that come after the own one
    CentreBox centres;                  ///< of its spheres, at most
    float greatest;                     ///< radius
    std::uint32_t first, end;           ///< its places
    bool wide;                          ///< its cells are as wide as four of the greatest radius
    std::size_t starts;  ///< where its part of `start` begins: buckets + 1 places, each where a bucket starts
  };

  float doubt = 1;           ///< as BlockTree::doubt
  bool each_radius = false;  ///< radii are read one by one even where they are equal
  bool wide = false;         ///< a single level's cells are as wide as four radii: where little is near
  bool equal_radii = false;  ///< all are the same number, of the build; a search reads one
  std::vector<Level> levels;
  LargeVector<std::uint32_t> start;
  LargeVector<float> x, y, z, radius;  ///< by place
  LargeVector<std::uint32_t> index;    ///< of the sphere in the chain, by place

  /// Spheres whose radii are within a factor of 2.
  struct Octave {
    std::uint32_t first, end;  ///< among the members
    float greatest;            ///< radius
  };

  /// Spheres that follow one another, by octave: how many, later where the next one goes.
  struct OctavePart {
    static constexpr std::size_t octaves =
        280;  ///< from the greatest binary32 number to the least; points last
    std::array<std::uint32_t, octaves> spheres{};
    std::array<float, octaves> greatest{};
  };

  /// Of the build: the octaves, coarse ones first.
  std::vector<Octave> octaves;
  /// The spheres by octave, in the order of the chain in each; empty where that is one level of all spheres.
  /// And by their number there their places, where there are several levels.
  LargeVector<std::uint32_t> members, place;
  std::vector<OctavePart> octave_parts;
  std::vector<std::uint32_t> part_place;  ///< first places of parts of the buckets that threads share out

  /// A level takes in finer spheres while no more of these are in the cell of one, itself among them, on
  /// average.
  static constexpr std::uint32_t most_in_a_cell = 4;

  std::uint32_t spheres() const { return static_cast<std::uint32_t>(index.size() - margin); }
  std::uint32_t member(std::uint32_t at) const { return members.empty() ? at : members[at]; }

  /// How many numbers past the last may be read from the fields.
  static constexpr std::size_t margin = 16;
};

/// Sorts the spheres, or `only` those of these indices, by octave of their radius and makes room for all but
/// the levels. O(n); does not allocate when neither n nor the number of octaves has grown.
void sort_by_octave(const ChainView& chain, std::span<const std::uint32_t> only, SphereGrid& grid,
                    const Team& team);

}  // namespace catena

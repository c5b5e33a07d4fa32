#pragma once
#include <cstdint>

#include "catena/core/cells/cell_table.h"
#include "catena/core/cells/counter.h"
#include "catena/core/host_device.h"

namespace catena {

/// Where in space there are spheres of a level at all: a bit for each cube of its cells, sixteen a side,
/// which some cubes share. Small spheres among few large ones need to know no more of most levels. Plain
/// pointers, valid in one memory space.
struct LevelMap {
  std::uint32_t* word;  ///< at first 0
  std::uint32_t log2_bits;

  /// For so many spheres at most; `words` of memory are the caller's to give.
  static LevelMap of(std::uint32_t spheres) {
    constexpr std::uint32_t least = 12, most = 31, of_sphere = 32;
    std::uint32_t log2_bits = least;
    while (log2_bits < most && 1u << log2_bits < std::uint64_t{of_sphere} * spheres) ++log2_bits;
    return {nullptr, log2_bits};
  }
  CATENA_HD std::uint32_t words() const { return 1u << (log2_bits - 5); }

  /// There is a sphere in that cell.
  CATENA_HD void mark(const PointCell& at, std::uint32_t level) const {
    const std::uint32_t bit = bit_of(Cubes(at.x).last, Cubes(at.y).last, Cubes(at.z).last, level);
    set_bits(word + bit / 32, 1u << bit % 32);
  }
  /// False only when there is none in the 27 cells around that one.
  CATENA_HD bool any_near(const PointCell& at, std::uint32_t level) const {
    const Cubes x(at.x, 1), y(at.y, 1), z(at.z, 1);
    for (std::int32_t k = z.first; k <= z.last; ++k)
      for (std::int32_t j = y.first; j <= y.last; ++j)
        for (std::int32_t i = x.first; i <= x.last; ++i) {
          const std::uint32_t bit = bit_of(i, j, k, level);
          if ((word[bit / 32] >> bit % 32 & 1) != 0) return true;
        }
    return false;
  }

 private:
  /// Those of the cells up to so many away along one axis: one, or two.
  struct Cubes {
    std::int32_t first, last;
    static constexpr std::uint32_t log2_side = 4;
    CATENA_HD explicit Cubes(const AxisCell& at, std::int32_t away = 0)
        : first((static_cast<std::int32_t>(at.cell) - away) >> log2_side),
          last((static_cast<std::int32_t>(at.cell) + away) >> log2_side) {}
  };
  static_assert(BucketMap::far_cell < 0x1p30, "numbers of cells are less, whatever they are made of");

  CATENA_HD std::uint32_t bit_of(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t level) const {
    std::uint32_t hash = static_cast<std::uint32_t>(x) * 0x8DA6B343u +
                         static_cast<std::uint32_t>(y) * 0xD8163841u +
                         static_cast<std::uint32_t>(z) * 0xCB1AB31Fu + level * 0x9E3779B1u;
    hash = (hash ^ hash >> 15) * 0x85EBCA6Bu;
    return hash >> (32 - log2_bits);
  }
};

}  // namespace catena

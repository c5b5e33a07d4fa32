#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#include "catena/core/cells/block_capsule.h"
#include "catena/core/cells/cell_table.h"
#include "catena/core/cells/counter.h"
#include "catena/core/chain/chain_view.h"

namespace catena {

/// The capsules of *blocks* of 32 consecutive spheres in hashed cells: plain pointers, valid in one memory
/// space. A level's cells are as wide as two capsules of it at most reach, in powers of two, so that what a
/// capsule meets of its own level or a coarser one lies in the 27 cells around its centre, and no rounding is
/// in the cells.
///
/// A block is *crowded* where this says little of what is near: a cell around it holds more than `slots`
/// capsules, or it meets more than `crowd` others of its level or coarser ones, or more than `most_met` finer
/// ones. Pairs of two crowded blocks are left to another search; all others are found here, by work that is
/// bounded for each block. A cell with too many capsules holds crowded blocks only, so that no others need to
/// be stored or looked for there.
struct CapsuleBlocks {
  static constexpr std::uint32_t block = 32;  ///< spheres
  static constexpr std::uint32_t slots = 8;   ///< capsules that a bucket holds
  static constexpr std::uint32_t most_partners = 8, most_met = 32;
  static constexpr std::uint8_t is_crowded = 0xFF, is_ordered = 0x80;
  static constexpr int least_width = -4;  ///< log2 of the width of level 0's cells

  struct State {
    std::uint32_t levels;   ///< bit k: there are capsules of level k
    std::uint32_t crowded;  ///< crowded blocks of every `sample`-th
    std::uint32_t any;      ///< not 0: there is a crowded block
  };

  CellTable table;
  float scale;  ///< block_scale: all capsules are of the chain times this
  std::uint32_t blocks, crowd, sample;
  BlockCapsule* capsule;
  std::uint8_t* shape;  ///< by block: its level, and is_ordered: no two spheres of it and the next collide
                        ///< but those next to one another
  std::uint32_t* in_bucket;  ///< capsules that came; at first 0
  std::uint32_t* bucket;     ///< `slots` each: 32 times the block, and its level
  std::uint8_t* partners;    ///< by block: how many it met, or is_crowded
  std::uint32_t* partner;    ///< by block, most_partners each
  std::uint32_t* met;        ///< by block: finer ones that met it; at first 0
  State* state;              ///< at first 0

  CATENA_HD static std::uint32_t blocks_of(std::uint32_t n) { return n / block + (n % block != 0); }
  /// What sizes and numbers a chain has; memory is the caller's to give.
  static CapsuleBlocks of(const ChainView& chain, std::uint32_t crowd, float scale) {
    CapsuleBlocks result{};
    result.blocks = blocks_of(chain.size);
    result.table = CellTable::of(2 * result.blocks);
    result.scale = scale;
    result.crowd = crowd;
    result.sample = 1 + result.blocks / 8192;
    return result;
  }

  CATENA_HD bool crowded(std::uint32_t b) const { return partners[b] == is_crowded || met[b] > most_met; }
  CATENA_HD bool ordered(std::uint32_t b) const { return (shape[b] & is_ordered) != 0; }
  CATENA_HD std::uint32_t level(std::uint32_t b) const { return shape[b] & ~std::uint32_t{is_ordered}; }
  /// About how many spheres are in crowded blocks, once all have met; no more than there are blocks for.
  CATENA_HD std::uint32_t crowded_spheres() const {
    const std::uint32_t about = state->crowded * sample;
    return block * (about < blocks ? about : blocks);
  }

  CATENA_HD static std::uint32_t level_of(float reach) {
    const int width = std::ilogb(2 * reach * (1 + 0x1p-16f)) + 1;  // 2^width is above twice the reach
    return static_cast<std::uint32_t>((width < least_width ? least_width : width) - least_width);
  }
  /// Where its centre's cell lies. No product is rounded, and no cell is far.
  CATENA_HD std::uint32_t bucket_of(const BlockCapsule& c, std::uint32_t level) const {
    const std::uint32_t bits = static_cast<std::uint32_t>(127 - least_width - static_cast<int>(level)) << 23;
    float cells_per_unit;
    std::memcpy(&cells_per_unit, &bits, sizeof bits);
    const auto cell = [&](float at) { return static_cast<double>(std::floor(at * cells_per_unit)); };
    return table.bucket(cell(c.centre.x), cell(c.centre.y), cell(c.centre.z), level);
  }
  /// Of 27, the bucket of the k-th cell around that of this bucket.
  CATENA_HD std::uint32_t around(std::uint32_t at, std::uint32_t k) const {
    const std::uint32_t row = table.on(at, table.step[k / 3]);
    return k % 3 == 0 ? table.before(row) : k % 3 == 1 ? row : table.on(row, 1);
  }
};

}  // namespace catena

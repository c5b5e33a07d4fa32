#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/block_capsule.h"
#include "catena/core/cells/buckets.h"
#include "catena/core/cells/counter.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/scattered.h"

namespace catena {

/// The capsules of *blocks* of 32 consecutive spheres: plain pointers, valid in one memory space. Whom a
/// block meets is first asked of a tree in the order of the chain (BlockNodes). Tangled blocks, of which that
/// says little, are put into hashed cells, and looked for there by one another. A level's cells are as wide
/// as two capsules of it at most reach, in powers of two, so that what a capsule meets of its own level or a
/// coarser one lies in the 27 cells around its centre, and no rounding is in the cells.
///
/// A block is *crowded* where this says little of what is near: a row of cells that it looks into holds more
/// than `dense` capsules, or it meets more than `crowd` others, or more than `most_met` finer ones do so in
/// the cells; or where to leave all to the search of crowded ones takes less (all_left). Pairs of two
/// crowded blocks are left to another search; all others are found here, by work that is bounded for each
/// block. A cell with more than `dense` capsules holds crowded blocks only, so that no others need to be
/// looked for there. Blocks that are crowded by what the tree says have their places in the cells too, where
/// tangled ones find them.
struct CapsuleBlocks {
  static constexpr std::uint32_t block = 32;  ///< spheres
  static constexpr std::uint32_t dense = 96;
  static constexpr std::uint32_t most_partners = 8, most_met = 32;
  static constexpr std::uint32_t most_window = block - 1, most_levels = 3, most_surveyed = 1024;
  static constexpr std::uint8_t is_ordered = 0x80, is_tangled = 0x40, level_bits = 0x1F;
  static constexpr std::uint32_t no_level = level_bits;
  static constexpr int least_width = -4;  ///< log2 of the width of level 0's cells

  /// Of the blocks that are asked before all others (BlockSurvey): how many it is known of, how many of these
  /// meet more than `crowd` others, how many do not, and whom the latter meet, in all. As one number, so that
  /// who looks at it while it grows sees all that one of them said, or nothing.
  struct Survey {
    std::uint32_t asked, crowded, others, partners;
    CATENA_HD static Survey of(unsigned long long number) {
      const auto part = [number](int k) { return static_cast<std::uint32_t>(number >> 16 * k & 0xFFFF); };
      return {part(0), part(1), part(2), part(3)};
    }
    CATENA_HD unsigned long long number() const {
      return asked | static_cast<unsigned long long>(crowded) << 16 |
             static_cast<unsigned long long>(others) << 32 | static_cast<unsigned long long>(partners) << 48;
    }
  };
  static_assert(most_surveyed * most_partners <= 0xFFFF);

  /// What is seen of some blocks before the survey (FirstLook): a bit for each.
  struct alignas(16) Look {
    static constexpr std::uint32_t asked = 64, words = asked / 32;
    std::uint32_t met[words];      ///< it met one of every `looked` blocks, and not one next to it
    std::uint32_t tangled[words];  ///< it does not go on in order
  };

  struct State {
    std::uint32_t places;       ///< blocks that were sorted
    std::uint32_t present;      ///< bit k: there are tangled blocks of level k
    std::uint32_t levels;       ///< the same, where they are searched for
    std::uint32_t crowded;      ///< crowded blocks of every `sample`-th, about
    std::uint32_t any;          ///< not 0: there is a crowded block
    std::uint32_t listed;       ///< not 0: there is a tangled one, for the cells
    unsigned long long survey;  ///< a Survey
  };

  CellTable table;
  float scale;  ///< block_scale: all capsules are of the chain times this
  std::uint32_t blocks, crowd, sample;
  std::uint32_t surveyed;       ///< blocks that are asked before all others (BlockSurvey)
  std::uint32_t many_partners;  ///< in sixteenths; see all_left()
  std::uint32_t looked;         ///< of so many blocks the first look takes one
  bool all_crowded;             ///< nothing is asked of blocks: the chain is too short for it to pay
  bool in_cells;   ///< tangled blocks are put into cells; else, where there are few blocks, they count as
                   ///< crowded
  bool alike;      ///< radii are
  bool own_units;  ///< some are so small beside the whole that squares of their lengths would be lost: each
                   ///< block, and each test of two, has a unit of its own
  std::uint32_t
      window;  ///< of the spheres further on in a block or the next, those which `ordered` leaves open
  BlockCapsule* capsule;
  std::uint8_t* shape;      ///< by block: its level, and is_ordered (BlockShape), is_tangled
  Buckets buckets;          ///< of blocks
  CapsuleBall* ball;        ///< by place
  std::uint32_t* id;        ///< by place: 32 times the block, and its level or no_level
  std::uint32_t* partners;  ///< by block: how many it met; anything above `crowd` where it is crowded
  std::uint32_t* partner;   ///< by block, most_partners each
  std::uint32_t* met;       ///< by block: finer ones that met it
  State* state;             ///< at first 0
  Look* look;               ///< all 0 between builds; nullptr: there is no such look

  CATENA_HD static std::uint32_t blocks_of(std::uint32_t n) { return n / block + (n % block != 0); }
  /// What sizes and numbers a chain has; memory is the caller's to give.
  static CapsuleBlocks of(const ChainView& chain, std::uint32_t crowd, float scale, std::uint64_t least,
                          std::uint64_t least_in_cells, std::uint32_t surveyed) {
    CapsuleBlocks result{};
    result.blocks = blocks_of(chain.size);
    result.table = CellTable::of(4 * result.blocks);
    result.scale = scale;
    result.crowd = crowd;
    result.sample = 1 + result.blocks / 8192;
    result.surveyed = std::min(surveyed, result.blocks);
    result.looked = std::max(4u, result.blocks / 8192);
    result.many_partners = many_partners_of(result.blocks);
    // Among spheres of very different sizes a grid of spheres is slower by far than what the order of the
    // chain says. Points are of one size, whatever the others are.
    constexpr float most_ratio = 64;
    const Extent& extent = chain.extent;
    result.alike = extent.least_radius == 0 || extent.greatest_radius <= most_ratio * extent.least_radius;
    constexpr float small = 0x1p-12f;  // beside 2^19, and so that BlockCapsule::tiny_of is nothing beside it
    result.own_units = extent.least_radius * scale < small;
    result.all_crowded = chain.size < least && result.alike;
    result.in_cells = chain.size >= least_in_cells && !result.all_crowded;
    // Elsewhere two spheres next to one another may belong to different strands, or be no neighbours.
    const bool one_window = chain.strand_count == 1 && chain.exclusion.rule == Exclusion::Rule::index_window;
    result.window = one_window ? std::min(chain.exclusion.window, most_window) : 1;
    return result;
  }

  /// For a search that asks the cells about every block, which are all to be told of as tangled.
  static CapsuleBlocks in_cells_alone(const ChainView& chain, std::uint32_t crowd, float scale) {
    return of(chain, crowd, scale, 0, 0, 0);
  }
  /// For a search that asks the tree alone: no block has partners, and none is crowded.
  static CapsuleBlocks in_tree_alone(const ChainView& chain, float scale) {
    return of(chain, most_partners, scale, 0, ~std::uint64_t{0}, 0);
  }

  CATENA_HD Sphere scaled(const Sphere& s) const {
    return {s.x * scale, s.y * scale, s.z * scale, s.radius * scale};
  }
  CATENA_HD bool crowded(std::uint32_t b) const {
    return partners[b] > crowd || met[b] > most_met || all_left();
  }
  /// The other search takes the same for every block. To compare a block here takes the longer the more
  /// partners it has, with many_partners about as long as there; and what was asked about one that is crowded
  /// was in vain, and took half of what one without partners saves (measured on an H200). So the other search
  /// gets all blocks where that is less in all. Known once a few were asked, before all are. Not where radii
  /// are unlike, among which it is slow, or where most of those asked are not known.
  CATENA_HD bool all_left() const { return all_left(Survey::of(state->survey)); }
  /// While others are asked still: whether that is so, and whether it is known. It is before the last one has
  /// spoken where half have, and it would be so even if all others had no partner.
  struct Left {
    bool all, known;
  };
  CATENA_HD Left left_by_now() const {
    Survey said = Survey::of(seen(&state->survey));
    const bool last = said.asked == surveyed, half = half_known(said);
    if (!last) said.others = surveyed - said.crowded;
    const bool all = half && all_left(said);
    return {all, all || last};
  }
  /// The same before the survey, by what a first look saw: who is tangled has two partners, next to it, and
  /// who met one of every `looked` others about so many more. It is to be so even if those who met nobody
  /// have none, who are few, as in a chain that is half laid out the others may be crowded.
  CATENA_HD bool left_at_first_look() const {
    constexpr std::uint32_t most = 40, nearly_all = 46;  // of those asked
    constexpr std::uint32_t telling = 8;  // where one stands for more, too few are met to be counted by
    constexpr std::uint32_t chance = 2;   // in sixteenths
    if (look == nullptr) return false;
    const Look saw = *look;
    std::uint32_t some = 0, in_no_order = 0, either = 0;
    for (std::uint32_t k = 0; k < Look::words; ++k) {
      some += count_bits(saw.met[k]), in_no_order += count_bits(saw.tangled[k]);
      either += count_bits(saw.met[k] | saw.tangled[k]);
    }
    return some >= most || (looked <= telling && either >= nearly_all &&
                            16 * (looked * some + 2 * in_no_order) > (many_partners + chance) * Look::asked);
  }
  /// The k-th block of the survey: of so many parts of the chain one each, anywhere in it, as what comes
  /// again in the chain may do so with the parts.
  CATENA_HD std::uint32_t surveyed_block(std::uint32_t k) const {
    const auto first = static_cast<std::uint32_t>(std::uint64_t{blocks} * k / surveyed);
    return first + scattered(k, blocks / surveyed);
  }
  /// The same of the first look, but that the last few blocks, less than one for each part, are in none: then
  /// a block tells by one division which it is.
  CATENA_HD std::uint32_t block_asked(std::uint32_t k) const {
    const std::uint32_t part = blocks / Look::asked;
    return k * part + scattered(k, part);
  }
  /// All blocks of the survey have spoken, or none needs to: before one of them, where it is known what they
  /// would say.
  CATENA_HD bool surveyed_all() const { return Survey::of(seen(&state->survey)).asked == surveyed; }
  CATENA_HD bool ordered(std::uint32_t b) const { return (shape[b] & is_ordered) != 0; }
  /// There is nothing to search between two blocks: they are the same one, or certified to go on in order.
  CATENA_HD bool settled(std::uint32_t a, std::uint32_t b) const {
    return a == b || (b == a + 1 && ordered(a)) || (a == b + 1 && ordered(b));
  }
  CATENA_HD std::uint32_t level(std::uint32_t b) const { return shape[b] & level_bits; }
  /// Each tangled block looks into all coarser levels. Where there are many, as long jumps in a chain make
  /// them, it is not worth it, and all tangled blocks count as crowded. Known once all were entered.
  CATENA_HD bool searched() const { return count_bits(state->present) <= most_levels; }
  CATENA_HD bool tangled(std::uint32_t b) const { return (shape[b] & is_tangled) != 0; }
  /// Blocks are put into cells.
  CATENA_HD bool any_in_cells() const { return state->listed != 0 && !all_left(); }
  /// Of tangled blocks, those that look for others: who is crowded by what it met in the tree has no need to.
  CATENA_HD bool looks(std::uint32_t b) const { return tangled(b) && partners[b] <= crowd; }
  /// About how many spheres are in crowded blocks, once all have met; no more than there are blocks for.
  CATENA_HD std::uint32_t crowded_spheres() const {
    const std::uint32_t about = all_left() ? blocks : state->crowded * sample;
    return block * (about < blocks ? about : blocks);
  }

  CATENA_HD static std::uint32_t level_of(float reach) {
    const int width = std::ilogb(2 * reach * (1 + 0x1p-16f)) + 1;  // 2^width is above twice the reach
    return static_cast<std::uint32_t>((width < least_width ? least_width : width) - least_width);
  }
  CATENA_HD static float cells_per_unit(std::uint32_t level) {
    return power_of_two(-least_width - static_cast<int>(level));
  }
  /// Where its centre's cell lies. No product is rounded, and no cell is far.
  CATENA_HD std::uint32_t bucket_of(const BlockCapsule& c, std::uint32_t level) const {
    const float per_unit = cells_per_unit(level);
    const auto cell = [&](float at) { return static_cast<double>(std::floor(at * per_unit)); };
    return table.bucket(cell(c.centre.x), cell(c.centre.y), cell(c.centre.z), level);
  }

  /// Cells next to one another along x.
  struct Row {
    std::uint32_t from, cells;
  };
  /// Those of the three cells of a row next to a capsule's own in which there may be something of that level,
  /// its own or a coarser one, that it touches: what lies beyond the border of a cell is at least as far from
  /// its centre as the border, and reaches half a cell at most (properties/proofs/capsule_rows.g).
  CATENA_HD Row row(const BlockCapsule& c, std::uint32_t level, std::uint32_t r) const {
    const float per_unit = cells_per_unit(level);
    const Way x(c.centre.x, c.half.x, c.radius, per_unit), y(c.centre.y, c.half.y, c.radius, per_unit),
        z(c.centre.z, c.half.z, c.radius, per_unit);
    if (!y.reaches(r % 3) || !z.reaches(r / 3)) return {0, 0};
    const std::uint32_t middle = table.on(table.bucket(x.cell, y.cell, z.cell, level), table.step[r]);
    return {x.below ? table.before(middle) : middle, 1u + (x.below ? 1 : 0) + (x.above ? 1 : 0)};
  }
  /// Of 27, the bucket of the k-th cell around that of this bucket.
  CATENA_HD std::uint32_t around(std::uint32_t at, std::uint32_t k) const {
    const std::uint32_t row = table.on(at, table.step[k / 3]);
    return k % 3 == 0 ? table.before(row) : k % 3 == 1 ? row : table.on(row, 1);
  }

 private:
  /// Fewer blocks take longer each, as one waits for another: of up to a million spheres one with 2.4
  /// partners takes as long as in the other search, from three million on one with four (walks and tight
  /// knots on an H200).
  static std::uint32_t many_partners_of(std::uint32_t blocks) {
    constexpr std::uint32_t few = 38, many = 64, a_million = 1'000'000 / block;
    const std::uint32_t more = std::min(blocks - std::min(blocks, a_million), 2 * a_million);
    return few + (many - few) * more / (2 * a_million);
  }
  CATENA_HD bool half_known(const Survey& said) const { return 2 * (said.crowded + said.others) >= surveyed; }
  CATENA_HD bool all_left(const Survey& said) const {
    return alike && half_known(said) && 16 * (said.partners + 2 * said.crowded) > many_partners * said.others;
  }
  /// A capsule along one axis: its centre's cell, and whether it touches anything in the cells beside that.
  struct Way {
    float cell;
    bool below, above;
    CATENA_HD Way(float centre, float half, float radius, float per_unit) {
      const float at = centre * per_unit;
      cell = std::floor(at);
      const float reach = (std::fabs(half) + radius) * per_unit + (0.5f + 0x1p-12f);
      below = at - cell <= reach;
      above = 1 - (at - cell) <= reach;
    }
    CATENA_HD bool reaches(std::uint32_t way) const { return way == 1 || (way == 0 ? below : above); }
  };
};

}  // namespace catena

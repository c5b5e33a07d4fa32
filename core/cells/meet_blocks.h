#pragma once
#include <cstdint>

#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/cells/fit_block.h"

namespace catena {

/// Steps of a CapsuleBlocks that find who meets whom; who runs them lets each step end before the next
/// begins.
class BlockMeeting {
 public:
  static constexpr std::uint32_t rows = 9;  ///< of cells, into which each block looks

  CATENA_HD explicit BlockMeeting(const CapsuleBlocks& blocks) : blocks_(blocks) {}

  /// Step 1, by a team: block b, whose sphere k and those after it are at(k) in the blocks' units. Teams that
  /// are in step with others come though there is no block b.
  template <class Team, class At>
  CATENA_HD void enclose(const Team& team, const At& at, std::uint32_t b) const {
    const BlockShape shape = BlockFit(team, at, blocks_.window, blocks_.own_units).shape();
    const std::uint32_t level = CapsuleBlocks::level_of(shape.capsule.reach);
    team.once([&] {
      if (b >= blocks_.blocks) return;
      blocks_.capsule[b] = shape.capsule;
      blocks_.shape[b] = static_cast<std::uint8_t>(level | (shape.ordered ? CapsuleBlocks::is_ordered : 0));
      blocks_.partners[b] = blocks_.met[b] = 0;
      if (blocks_.look != nullptr && !shape.ordered) note_tangled(b);
    });
  }

  // Step 2 is that of the nodes' boxes.
  /// Step 3, for each block, which met so many others in the tree unless it is tangled (PartnerSearch). Who
  /// is crowded counts as tangled from now on where there are cells, so that tangled ones find it there.
  CATENA_HD void tell(std::uint32_t b, bool tangled, std::uint32_t partners) const {
    const bool crowded = partners > blocks_.crowd && !tangled;
    blocks_.partners[b] = tangled ? 0 : partners;
    if (crowded) note_crowded(b);
    if (tangled && !blocks_.in_cells) crowd(b);
    if (!blocks_.in_cells || (!tangled && !crowded)) return;
    blocks_.shape[b] |= CapsuleBlocks::is_tangled;
    set_bits(&blocks_.state->listed, 1);
  }
  /// The same where the tree is not asked: all are looked for in cells.
  CATENA_HD void tell_tangled(std::uint32_t b) const { tell(b, true, 0); }

  /// Step 4, for each block where tangled ones are put into cells.
  CATENA_HD void enter(std::uint32_t b) const {
    if (!blocks_.tangled(b)) return;
    const std::uint32_t level = blocks_.level(b);
    blocks_.buckets.enter(blocks_.bucket_of(blocks_.capsule[b], level), b);
    set_bits(&blocks_.state->present, 1u << level);
  }

  // Step 5 is that of the buckets.
  /// Step 6, for each block.
  CATENA_HD void place(std::uint32_t b) const {
    if (!blocks_.tangled(b)) return;
    const BlockCapsule capsule = blocks_.capsule[b];
    const std::uint32_t level = blocks_.level(b),
                        at = blocks_.buckets.place(blocks_.bucket_of(capsule, level), b);
    const bool searched = blocks_.searched();
    blocks_.ball[at] = ball_of(capsule);
    blocks_.id[at] = b << 5 | (searched ? level : CapsuleBlocks::no_level);
    if (searched)
      set_bits(&blocks_.state->levels, 1u << level);
    else
      crowd(b);
  }

  /// Step 7, for each level, each tangled block of it or a finer one, and each row of cells: the places to
  /// look at, side by side; mostly all.
  CATENA_HD Buckets::Run look(std::uint32_t b, std::uint32_t level, std::uint32_t row,
                              CapsuleBlocks::Row& rest) const {
    rest = blocks_.row(blocks_.capsule[b], level, row);
    return rest.cells > 0 ? look_on(rest) : Buckets::Run{0, 0};
  }
  /// And the next ones, where there are any.
  CATENA_HD Buckets::Run look_on(CapsuleBlocks::Row& rest) const {
    return blocks_.buckets.take(blocks_.table, rest.from, rest.cells);
  }
  /// So many are not looked at; the block is crowded.
  CATENA_HD static bool too_many(const Buckets::Run& run) {
    return run.end - run.first > CapsuleBlocks::dense;
  }
  CATENA_HD void crowd(std::uint32_t b) const {
    if (fetch_add(blocks_.partners + b, blocks_.crowd + 1) <= blocks_.crowd) note_crowded(b);
  }

  /// Block b, in this ball, may meet the block at a place; then note() is to be called of the two.
  CATENA_HD bool may_meet(std::uint32_t b, const CapsuleBall& ball, std::uint32_t level,
                          std::uint32_t at) const {
    if (far_apart(ball, blocks_.ball[at], blocks_.own_units)) return false;
    const std::uint32_t id = blocks_.id[at];
    return (id & 31) == level && !blocks_.settled(b, id >> 5);
  }
  CATENA_HD std::uint32_t block_at(std::uint32_t place) const { return blocks_.id[place] >> 5; }
  CATENA_HD void note(std::uint32_t b, std::uint32_t other) const {
    if (separate(blocks_.capsule[b], blocks_.capsule[other], blocks_.own_units)) return;
    add_partner(b, other);
    if (blocks_.level(other) != blocks_.level(b) &&
        fetch_add(blocks_.met + other, 1) == CapsuleBlocks::most_met)
      note_crowded(other);
  }

 private:
  CATENA_HD void add_partner(std::uint32_t b, std::uint32_t other) const {
    const std::uint32_t before = fetch_add(blocks_.partners + b, 1);
    if (before < blocks_.crowd)
      blocks_.partner[b * CapsuleBlocks::most_partners + before] = other;
    else if (before == blocks_.crowd)
      note_crowded(b);
  }
  CATENA_HD void note_tangled(std::uint32_t b) const {
    const std::uint32_t k = b / (blocks_.blocks / CapsuleBlocks::Look::asked);
    if (k < CapsuleBlocks::Look::asked && blocks_.block_asked(k) == b)
      set_bits(blocks_.look->tangled + k / 32, 1u << k % 32);
  }
  CATENA_HD void note_crowded(std::uint32_t b) const {
    set_bits(&blocks_.state->any, 1);
    if (b % blocks_.sample == 0) fetch_add(&blocks_.state->crowded, 1);
  }

  const CapsuleBlocks& blocks_;
};

}  // namespace catena

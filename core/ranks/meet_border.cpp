// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/ranks/meet_border.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <bit>

#include "catena/core/blocks/compress-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/meeting-inl.h"
#include "catena/core/blocks/sphere_tiles-inl.h"
#include "catena/core/hierarchy/box_around.h"
#include "catena/core/ranks/meet_border.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

using ranks::Block;
using ranks::Border;

/// The boxes of a border that meet one.
class MetBoxes {
 public:
  /// The numbers, ascending, of those that this rank compares: see Border::compared. Level by level, as a
  /// walk from box to box is what no processor foresees.
  HWY_INLINE std::span<const std::uint32_t> of(const WideBoxTree& tree, const Box& box,
                                               std::uint32_t compared) {
    const std::span<const std::vector<WideBoxTree::Group>> levels = tree.levels();
    if (levels.empty()) return {};
    groups_.resize(1);
    groups_[0] = 0;
    std::uint64_t boxes_of_a_child = std::uint64_t{1} << 4 * (levels.size() - 1);  // the fan's power
    for (std::size_t l = levels.size(); l-- > 0; boxes_of_a_child /= WideBoxTree::fan) {
      const std::uint32_t lanes = lanes_compared(compared, boxes_of_a_child);
      children_.resize(groups_.size() * WideBoxTree::fan);
      std::uint32_t* to = children_.data();
      for (const std::uint32_t group : groups_)
        to = store_set(meeting(levels[l][group], box) & lanes, group * WideBoxTree::fan, to);
      children_.resize(static_cast<std::size_t>(to - children_.data()));
      std::swap(groups_, children_);
    }
    return groups_;
  }

 private:
  /// Which children of any group have a box of the border that is compared; those that `compared` parts as a
  /// whole, or that are parted themselves, all.
  static HWY_INLINE std::uint32_t lanes_compared(std::uint32_t compared, std::uint64_t boxes_of_a_child) {
    constexpr std::uint32_t second_half[] = {0xAAAA, 0xCCCC, 0xF0F0, 0xFF00};
    const std::uint64_t child = compared / boxes_of_a_child;
    return child == 0 || child >= WideBoxTree::fan ? 0xFFFF : second_half[std::countr_zero(child)];
  }
  /// first + k for each bit k that is set. May write as many as a group has.
  static HWY_INLINE std::uint32_t* store_set(std::uint32_t set, std::uint32_t first, std::uint32_t* to) {
    const hn::CappedTag<std::uint32_t, WideBoxTree::fan> tag;
    for (std::uint32_t k = 0; k < WideBoxTree::fan; k += hn::MaxLanes(tag)) {
      const Kept<decltype(tag)> kept(lanes_of(tag, set >> k));
      hn::StoreU(kept.compress(count_up(tag, first + k)), tag, to);
      to += kept.size();
    }
    return to;
  }

  LargeVector<std::uint32_t> groups_, children_;
};

/// Which of eight spheres have a box around them, Box::around of each, that meets this one.
HWY_INLINE std::uint32_t boxes_meeting(const Sphere* spheres, const Box& box) {
  using Tag = Lanes8::Tag;
  Lanes8 centre[3], radius;
  for (std::size_t k = 0; k < Lanes8::parts; ++k)
    hn::LoadInterleaved4(Tag(), reinterpret_cast<const float*>(spheres + k * Lanes8::width),
                         centre[0].part[k], centre[1].part[k], centre[2].part[k], radius.part[k]);
  Lanes8 step = Lanes8::all(0x1p-23f);
  const auto axis = [&](int d) HWY_ATTR {
    Lanes8 low = centre[d] - radius, high = centre[d] + radius;
    return not_less(Lanes8::all(box.high[d]), low - abs(low) * step) &
           not_less(high + abs(high) * step, Lanes8::all(box.low[d]));
  };
  return (axis(0) & axis(1) & axis(2)).bits();
}

/// Of `columns` spheres of each of `rows` rows, eight by eight.
HWY_INLINE std::uint64_t first_of(std::size_t rows, std::size_t columns) {
  const std::uint64_t row = (1u << columns) - 1;
  return row * 0x0101010101010101u & ~std::uint64_t{0} >> 8 * (Block::most - rows);
}

}  // namespace

std::uint64_t meet_border_here(const Border& border, const ranks::FarBlocks& far, std::uint64_t most,
                               std::uint32_t& far_block, LargeVector<ranks::Meeting>& meetings) {
  MetBoxes boxes;
  std::uint64_t met = 0;
  for (; far_block < far.blocks() && met < most; ++far_block) {
    const std::span<const Sphere> spheres = far.spheres(far_block);
    const std::span<const std::uint32_t> own =
        boxes.of(border.boxes(), box_around(spheres), far.mark(far_block));
    met += own.size();
    Sphere eight[Block::most]{};
    std::ranges::copy(spheres, eight);
    const SphereTiles tiles(eight);
    const std::size_t before = meetings.size();
    meetings.resize(before + own.size());
    ranks::Meeting* to = meetings.data() + before;
    for (const std::uint32_t b : own) {
      const SphereTiles::Verdict verdict = tiles.compare(border.eight(b), Robust::binary32_slack);
      const std::uint64_t filled = first_of(border.blocks()[b].size, spheres.size());
      *to = {far_block, b, row_by_row(verdict.overlap) & filled, row_by_row(verdict.open) & filled};
      to += (to->touch | to->may_touch) != 0;
    }
    meetings.resize(static_cast<std::size_t>(to - meetings.data()));
  }
  return met;
}

void may_touch_border_here(const Border& border, std::span<const ranks::BlockBox> boxes,
                           std::uint32_t compared, std::vector<std::uint32_t>& blocks) {
  MetBoxes met;
  for (const auto& [block, box] : boxes)
    for (const std::uint32_t b : met.of(border.boxes(), box, compared))
      if (boxes_meeting(border.eight(b), box) != 0) {
        blocks.push_back(block);
        break;
      }
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(meet_border_here);
HWY_EXPORT(may_touch_border_here);

namespace ranks {

std::uint64_t meet_border(const Border& border, const FarBlocks& far, std::uint64_t most,
                          std::uint32_t& far_block, LargeVector<Meeting>& meetings) {
  return HWY_DYNAMIC_DISPATCH(meet_border_here)(border, far, most, far_block, meetings);
}

void may_touch_border(const Border& border, std::span<const BlockBox> boxes, std::uint32_t compared,
                      std::vector<std::uint32_t>& blocks) {
  HWY_DYNAMIC_DISPATCH(may_touch_border_here)(border, boxes, compared, blocks);
}

}  // namespace ranks
}  // namespace catena
#endif

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
#include "catena/core/ranks/told_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

using ranks::Block;
using ranks::Border;

/// The boxes of those blocks of a border that this rank compares: see Border::compared.
class ComparedBoxes {
 public:
  HWY_INLINE ComparedBoxes(const WideBoxTree& tree, std::uint32_t compared) : levels_(tree.levels()) {
    for (std::size_t l = 0; l < levels_.size(); ++l) lanes_[l] = lanes_of_level(l, compared);
  }

  /// The numbers of those that meet one, ascending. Level by level, as a walk from box to box is what no
  /// processor foresees. The lists are any.
  HWY_INLINE std::span<const std::uint32_t> meeting(const Box& box, LargeVector<std::uint32_t>& groups,
                                                    LargeVector<std::uint32_t>& children) const {
    groups.assign(levels_.empty() ? 0 : 1, 0);
    for (std::size_t l = levels_.size(); l-- > 0;) {
      children.resize(groups.size() * WideBoxTree::fan);
      std::uint32_t* to = children.data();
      for (const std::uint32_t group : groups)
        to = store_set(met(l, group, box), group * WideBoxTree::fan, to);
      children.resize(static_cast<std::size_t>(to - children.data()));
      std::swap(groups, children);
    }
    return groups;
  }

  /// Whether test(b) holds for one that meets this box; those after it are not asked for, as there may be
  /// many.
  template <class Test>
  HWY_INLINE bool any_meeting(const Box& box, const Test& test) const {
    if (levels_.empty()) return false;
    struct Level {
      std::uint32_t group, left;
    } at[most_levels];
    std::size_t l = levels_.size() - 1;
    at[l] = {0, met(l, 0, box)};
    for (;;) {
      if (at[l].left == 0) {
        if (++l == levels_.size()) return false;
        continue;
      }
      const std::uint32_t child =
          at[l].group * WideBoxTree::fan + static_cast<std::uint32_t>(std::countr_zero(at[l].left));
      at[l].left &= at[l].left - 1;
      if (l > 0) {
        --l;
        at[l] = {child, met(l, child, box)};
      } else if (test(child)) {
        return true;
      }
    }
  }

 private:
  static constexpr std::size_t most_levels = 9;  ///< more than 2^32 boxes have
  static constexpr std::size_t bits_a_level = 4;
  static_assert(WideBoxTree::fan == 1 << bits_a_level);

  /// Children of a group of this level that meet the box.
  HWY_INLINE std::uint32_t met(std::size_t l, std::uint32_t group, const Box& box) const {
    return catena::HWY_NAMESPACE::meeting(levels_[l][group], box) & lanes_[l];
  }
  /// Which children of any group have a box that is compared; those that `compared` parts as a whole, or that
  /// are parted themselves, all.
  static HWY_INLINE std::uint32_t lanes_of_level(std::size_t l, std::uint32_t compared) {
    constexpr std::uint32_t second_half[] = {0xAAAA, 0xCCCC, 0xF0F0, 0xFF00};
    const std::uint64_t child = std::uint64_t{compared} >> bits_a_level * l;
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

  const std::span<const std::vector<WideBoxTree::Group>> levels_;
  std::uint32_t lanes_[most_levels];
};

}  // namespace

std::uint64_t meet_border_here(const Border& border, const ranks::FarBlocks& far, std::uint64_t most,
                               std::uint32_t& far_block, LargeVector<ranks::Meeting>& meetings) {
  constexpr std::size_t some = 1 << 10;  // as one block may meet the whole border
  LargeVector<std::uint32_t> groups, children;
  std::uint64_t met = 0;
  for (; far_block < far.blocks() && met < most; ++far_block) {
    const std::span<const Sphere> spheres = far.spheres(far_block);
    Sphere eight[Block::most]{};
    std::ranges::copy(spheres, eight);
    const SphereTiles tiles(eight);
    const ComparedBoxes boxes(border.boxes(), far.mark(far_block));
    std::span<const std::uint32_t> own = boxes.meeting(box_around(spheres), groups, children);
    met += own.size();
    while (!own.empty()) {
      const std::span<const std::uint32_t> these = own.first(std::min(some, own.size()));
      own = own.subspan(these.size());
      const std::size_t before = meetings.size();
      meetings.resize(before + these.size());
      ranks::Meeting* to = meetings.data() + before;
      for (const std::uint32_t b : these) {
        SphereTiles::Verdict verdict = tiles.compare(border.eight(b), Robust::binary32_slack);
        verdict.keep(within_first(border.blocks()[b].size, static_cast<std::uint32_t>(spheres.size())));
        *to = {far_block, b, row_by_row(verdict.overlap), row_by_row(verdict.open)};
        to += (to->touch | to->may_touch) != 0;
      }
      meetings.resize(static_cast<std::size_t>(to - meetings.data()));
    }
  }
  return met;
}

void may_touch_border_here(const Border& border, std::span<const ranks::ToldBlock> told,
                           std::uint32_t compared, std::vector<std::uint32_t>& blocks) {
  const ComparedBoxes own(border.boxes(), compared);
  for (const ranks::ToldBlock& block : told) {
    const Box box = block.box();
    const ToldLanes capsule(block);
    const auto may_touch = [&](std::uint32_t b) HWY_ATTR {
      std::uint32_t near = capsule.may_touch(border.eight(b)) & lane_bits(border.blocks()[b].size);
      for (; near != 0; near &= near - 1)
        if (block.may_touch(border.eight(b)[std::countr_zero(near)])) return true;
      return false;
    };
    if (own.any_meeting(box, may_touch)) blocks.push_back(block.block);
  }
}

void tell_of_border_here(const Border& border, std::span<const std::uint32_t> blocks,
                         std::vector<ranks::ToldBlock>& told) {
  for (const std::uint32_t b : blocks) {
    const std::span<const Sphere> spheres = border.spheres(b);
    ranks::ToldBlock block = ranks::ToldBlock::along(b, spheres);
    block.radius = ToldLanes(block).holding(border.eight(b), static_cast<std::uint32_t>(spheres.size()));
    constexpr float least = 0x1p-40f, most = 0x1p120f;
    if (!(least < block.radius && block.radius < most)) block.hold(spheres);
    told.push_back(block);
  }
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(meet_border_here);
HWY_EXPORT(may_touch_border_here);
HWY_EXPORT(tell_of_border_here);

namespace ranks {

std::uint64_t meet_border(const Border& border, const FarBlocks& far, std::uint64_t most,
                          std::uint32_t& far_block, LargeVector<Meeting>& meetings) {
  return HWY_DYNAMIC_DISPATCH(meet_border_here)(border, far, most, far_block, meetings);
}

void may_touch_border(const Border& border, std::span<const ToldBlock> told, std::uint32_t compared,
                      std::vector<std::uint32_t>& blocks) {
  HWY_DYNAMIC_DISPATCH(may_touch_border_here)(border, told, compared, blocks);
}

void tell_of_border(const Border& border, std::span<const std::uint32_t> blocks,
                    std::vector<ToldBlock>& told) {
  HWY_DYNAMIC_DISPATCH(tell_of_border_here)(border, blocks, told);
}

}  // namespace ranks
}  // namespace catena
#endif

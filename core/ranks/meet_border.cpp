// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/ranks/meet_border.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <bit>

#include "catena/core/blocks/meeting-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/hierarchy/box_around.h"
#include "catena/core/ranks/meet_border.h"
#include "hwy/cache_control.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

using ranks::Block;
using ranks::Border;
using ranks::HeldPart;

/// test(b) for blocks of the border whose boxes meet this one, ascending, until it says true.
template <class Test>
HWY_INLINE bool any_meeting(const WideBoxTree& tree, const Box& box, const Test& test) {
  const std::span<const std::vector<WideBoxTree::Group>> levels = tree.levels();
  if (levels.empty()) return false;
  constexpr std::size_t most_levels = 9;  // more than 2^32 boxes have
  struct Level {
    std::uint32_t group, left;
  } at[most_levels];
  std::size_t l = levels.size() - 1;
  at[l] = {0, meeting(levels[l][0], box)};
  for (;;) {
    if (at[l].left == 0) {
      if (++l == levels.size()) return false;
      continue;
    }
    const std::uint32_t child =
        at[l].group * WideBoxTree::fan + static_cast<std::uint32_t>(std::countr_zero(at[l].left));
    at[l].left &= at[l].left - 1;
    if (l > 0) {
      --l;
      at[l] = {child, meeting(levels[l][child], box)};
    } else if (test(child)) {
      return true;
    }
  }
}

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

/// One block that came, its spheres side by side.
class FarBlock {
 public:
  explicit HWY_INLINE FarBlock(std::span<const Sphere> spheres)
      : lanes_(eight(spheres).spheres),
        filled_(lane_bits(static_cast<std::uint32_t>(spheres.size())) * 0x0101010101010101u) {}

  /// See Meeting. Of a full block all eight are tested: to leave out those whose boxes are apart is a branch
  /// that no processor foresees, which takes longer.
  HWY_INLINE std::uint64_t may_touch(std::span<const Sphere> own) const {
    std::uint64_t bits = 0;
    const auto test = [&](std::size_t k) HWY_ATTR {
      bits |= std::uint64_t{SphereLanes::may_overlap(lanes_.squares(own[k])).bits()} << (8 * k);
    };
    if (own.size() == Block::most) {
#pragma GCC unroll 8
      for (std::size_t k = 0; k < Block::most; ++k) test(k);
    } else {
      for (std::size_t k = 0; k < own.size(); ++k) test(k);
    }
    return bits & filled_;
  }

 private:
  struct Eight {
    Sphere spheres[Block::most];
  };
  static HWY_INLINE Eight eight(std::span<const Sphere> spheres) {
    Eight all;
    std::fill(std::copy(spheres.begin(), spheres.end(), all.spheres), all.spheres + Block::most,
              spheres.back());
    return all;
  }

  const SphereLanes lanes_;
  const std::uint64_t filled_;  ///< the lanes that hold a sphere, eight times
};

}  // namespace

std::uint64_t meet_border_here(const HeldPart& part, const Border& border, const ranks::FarBlocks& far,
                               std::uint64_t most, std::uint32_t& far_block,
                               std::vector<ranks::Meeting>& meetings) {
  const std::span<const Block> blocks = border.blocks();
  std::vector<std::uint32_t> own;
  std::uint64_t met = 0;
  for (; far_block < far.blocks() && met < most; ++far_block) {
    const std::span<const Sphere> spheres = far.spheres(far_block);
    const std::uint32_t compared = far.mark(far_block);
    const Box box = box_around(spheres);
    own.clear();
    any_meeting(border.boxes(), box, [&](std::uint32_t b) HWY_ATTR {
      ++met;
      if (!ranks::is_compared(b, compared)) return false;            // the other rank's
      const std::span<const Sphere> soon = part.spheres(blocks[b]);  // they lie anywhere in the part
      hwy::Prefetch(&soon.front()), hwy::Prefetch(&soon.back());
      own.push_back(b);
      return false;
    });
    const FarBlock block(spheres);
    for (const std::uint32_t b : own)
      if (const std::uint64_t bits = block.may_touch(part.spheres(blocks[b])); bits != 0)
        meetings.push_back({far_block, b, bits});
  }
  return met;
}

bool may_touch_border_here(const HeldPart& part, const Border& border, const Box& box,
                           std::uint32_t compared) {
  return any_meeting(border.boxes(), box, [&](std::uint32_t b) HWY_ATTR {
    if (!ranks::is_compared(b, compared)) return false;
    const std::span<const Sphere> spheres = part.spheres(border.blocks()[b]);
    return spheres.size() == Block::most ? boxes_meeting(spheres.data(), box) != 0
                                         : MeetsBox(box).any_of(spheres);
  });
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(meet_border_here);
HWY_EXPORT(may_touch_border_here);

namespace ranks {

std::uint64_t meet_border(const HeldPart& part, const Border& border, const FarBlocks& far,
                          std::uint64_t most, std::uint32_t& far_block, std::vector<Meeting>& meetings) {
  return HWY_DYNAMIC_DISPATCH(meet_border_here)(part, border, far, most, far_block, meetings);
}

bool may_touch_border(const HeldPart& part, const Border& border, const Box& box, std::uint32_t compared) {
  return HWY_DYNAMIC_DISPATCH(may_touch_border_here)(part, border, box, compared);
}

}  // namespace ranks
}  // namespace catena
#endif

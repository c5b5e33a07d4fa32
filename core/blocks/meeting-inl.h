// Which boxes of a WideBoxTree meet one, sixteen at a time.
#if defined(CATENA_CORE_BLOCKS_MEETING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_MEETING_INL_H
#undef CATENA_CORE_BLOCKS_MEETING_INL_H
#else
#define CATENA_CORE_BLOCKS_MEETING_INL_H
#endif

#include "catena/core/blocks/lanes-inl.h"
#include "catena/core/hierarchy/wide_box_tree.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Bit k: box k meets this one; an empty one none. Not less, rather than at most: what is no number meets.
HWY_INLINE std::uint32_t meeting(const WideBoxTree::Group& g, const Box& box) {
  const auto axis = [&](int d) {
    return not_less(Lanes16::all(box.high[d]), Lanes16::load(g.low[d].data())) &
           not_less(Lanes16::load(g.high[d].data()), Lanes16::all(box.low[d]));
  };
  const auto filled = not_less(Lanes16::load(g.high[0].data()), Lanes16::load(g.low[0].data()));
  return ((axis(0) & axis(1)) & (axis(2) & filled)).bits();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

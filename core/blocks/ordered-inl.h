// Which two consecutive blocks are certain to have no collision within and between them but of spheres next
// to one another: along one direction the spheres follow one another like beads.
#if defined(CATENA_CORE_BLOCKS_ORDERED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_ORDERED_INL_H
#undef CATENA_CORE_BLOCKS_ORDERED_INL_H
#else
#define CATENA_CORE_BLOCKS_ORDERED_INL_H
#endif

#include "catena/core/blocks/capsules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Bit k: block k and the next are ordered. `own` are the blocks' spheres relative to `centre`, as
/// capsules_around leaves them, and `next` those of the following block in place. Along a direction U of
/// length at most `length`, sphere i reaches from L_i = s_i - r_i length to H_i = s_i + r_i length; where L
/// never falls and H_i < L_(i+2), sphere i ends before every sphere from i + 2 on begins. The slack is for
/// the rounding of s, L and H.
HWY_INLINE std::uint32_t ordered_windows(const BlockSpheres& own, const Vectors& centre, const Lanes16& reach,
                                         const BlockSpheres& next) {
  constexpr std::uint32_t places = 2 * BlockTree::block, last = BlockTree::block - 1;
  Vectors at[BlockTree::block];  // of the next block, relative to this one's centre
  Lanes16 far = reach;
  for (std::uint32_t j = 0; j <= last; ++j) {
    at[j] = next.at[j] - centre;
    far = max(far, sum_of_sides(at[j]) + next.radius[j]);
  }
  const Vectors direction = at[last] - own.at[0];
  const Lanes16 length = sqrt(dot(direction, direction)) * Lanes16::all(1 + 0x1p-16f);
  const Lanes16 slack = length * far * Lanes16::all(BlockTree::slack) + Lanes16::all(0x1p-60f);
  Lanes16 low[places], high[places];
  for (std::uint32_t j = 0; j < places; ++j) {
    const bool mine = j < BlockTree::block;
    const Lanes16 s = dot(mine ? own.at[j] : at[j - BlockTree::block], direction);
    const Lanes16 r = mine ? own.radius[j] : next.radius[j - BlockTree::block];
    low[j] = neg_mul_add(r, length, s);
    high[j] = mul_add(r, length, s) + slack;
  }
  Flags<16> ordered = low[0] <= low[1];
  for (std::uint32_t j = 1; j + 1 < places; ++j) ordered = ordered & (low[j] <= low[j + 1]);
  for (std::uint32_t j = 0; j + 2 < places; ++j) ordered = ordered & (high[j] < low[j + 2]);
  return ordered.bits();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

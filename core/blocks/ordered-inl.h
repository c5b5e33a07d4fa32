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

/// Sphere j of the block after each of sixteen; that after the last is the first of `after`.
HWY_INLINE Vectors next_at(const BlockSpheres& s, std::uint32_t j, const Sphere* after, float scale) {
  return {shifted(s.at[j].x, after[j].x * scale), shifted(s.at[j].y, after[j].y * scale),
          shifted(s.at[j].z, after[j].z * scale)};
}

/// Bit k: block k and the next are ordered. `s` are sixteen blocks, `centre` and `reach` those that
/// capsules_around gave, and the block after the last begins at `after`. Along a direction U of length at
/// most `length`, sphere i reaches from L_i = s_i - r_i length to H_i = s_i + r_i length; where L never falls
/// and H_i < L_(i+2), sphere i ends before every sphere from i + 2 on begins. The slack is for the rounding
/// of s, L and H.
HWY_INLINE std::uint32_t ordered_windows(const BlockSpheres& s, const Vectors& centre, const Lanes16& reach,
                                         const Sphere* after, float scale) {
  constexpr std::uint32_t block = BlockTree::block;
  Vectors direction = next_at(s, block - 1, after, scale) - s.at[0];
  Lanes16 zero = Lanes16::all(0), least = Lanes16::all(least_product);
  Lanes16 length = sqrt(dot(direction, direction, least)) * Lanes16::all(1 + 0x1p-16f);
  Lanes16 low[2] = {zero, zero}, high[2] = {zero, zero};  // of the sphere before the last, and of the last
  Lanes16 far = reach, least_gap = zero, least_rise = zero;
  for (std::uint32_t j = 0; j < 2 * block; ++j) {
    const bool mine = j < block;
    Vectors at = (mine ? s.at[j] : next_at(s, j - block, after, scale)) - centre;
    Lanes16 r = mine ? s.radius[j] : shifted(s.radius[j - block], after[j - block].radius * scale);
    if (!mine) far = max(far, sum_of_sides(at) + r);
    Lanes16 middle = dot(at, direction, least);
    Lanes16 low_j = neg_mul_add(r, length, middle), high_j = mul_add(r, length, middle);
    if (j > 0) least_rise = min(least_rise, low_j - low[1]);
    if (j > 1) least_gap = j == 2 ? low_j - high[0] : min(least_gap, low_j - high[0]);
    low[0] = low[1], high[0] = high[1], low[1] = low_j, high[1] = high_j;
  }
  Lanes16 slack = length * far * Lanes16::all(BlockTree::slack) + Lanes16::all(BlockTree::tiny);
  return ((slack < least_gap) & (zero <= least_rise)).bits();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Whether spheres overlap, as far as binary32 can say, a vector of pairs at a time.
#if defined(CATENA_CORE_BLOCKS_OVERLAP_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_OVERLAP_TEST_INL_H
#undef CATENA_CORE_BLOCKS_OVERLAP_TEST_INL_H
#else
#define CATENA_CORE_BLOCKS_OVERLAP_TEST_INL_H
#endif

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/blocks/squares_in_range.h"
#include "catena/core/chain/chain_view.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Stage 1 of Robust for spheres of a chain: q = |cA - cB|^2 against t = (rA + rB)^2.
class OverlapTest {
 public:
  using Tag = hn::CappedTag<float, 16>;
  using Vec = hn::Vec<Tag>;
  struct Verdict {
    hn::Mask<Tag> may, certain;
  };

  /// `doubt` as BlockTree::doubt.
  HWY_INLINE OverlapTest(const Extent& extent, float doubt) : slack_(Robust::binary32_slack * doubt) {
    own_units_ = sums_in_range(extent) &&
                 !(squares_in_range(extent.least_radius) && squares_in_range(extent.greatest_radius));
  }

  /// From differences of centres and sums of radii. A NaN overlaps nothing.
  HWY_INLINE Verdict operator()(Vec dx, Vec dy, Vec dz, Vec reach) const {
    const Tag tag;
    if (HWY_UNLIKELY(own_units_)) {
      const Vec unit = unit_of(reach);
      dx = hn::Mul(dx, unit), dy = hn::Mul(dy, unit), dz = hn::Mul(dz, unit), reach = hn::Mul(reach, unit);
    }
    const Vec slack = hn::Set(tag, slack_), floor = hn::Set(tag, Robust::underflow_floor);
    const Vec q = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), t = hn::Mul(reach, reach);
    return {hn::Le(q, hn::MulAdd(t, slack, floor)), hn::Lt(hn::MulAdd(q, slack, floor), t)};
  }

 private:
  /// A power of two that makes each sum of radii 1 to 2, where it is normal and below 2^127: squares keep
  /// their digits, whatever the spheres' size. It loses none; what overflows is far apart, and what
  /// underflows weighs nothing beside t.
  static HWY_INLINE Vec unit_of(Vec reach) {
    const Tag tag;
    const hn::RebindToUnsigned<Tag> bits;
    constexpr std::uint32_t exponent = 0x7F800000, of_inverse = 0x7F000000;
    return hn::BitCast(
        tag, hn::Sub(hn::Set(bits, of_inverse), hn::And(hn::BitCast(bits, reach), hn::Set(bits, exponent))));
  }

  float slack_;
  bool own_units_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// What binary64 tells of a sphere and several others that binary32 leaves open: stage 2 of Robust, and what
// of stage 3 is free of rounding.
#if defined(CATENA_CORE_BLOCKS_EXACT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_EXACT_LANES_INL_H
#undef CATENA_CORE_BLOCKS_EXACT_LANES_INL_H
#else
#define CATENA_CORE_BLOCKS_EXACT_LANES_INL_H
#endif

#include <cstdint>

#include "catena/core/blocks/simd_targets.h"
#include "catena/core/sphere.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Up to sixteen spheres, one number after another.
struct SphereRows {
  alignas(64) float x[16], y[16], z[16], radius[16];
};

/// Bit k: sphere k of the rows overlaps or touches; it is not told, and another must decide.
struct Told {
  std::uint32_t overlap = 0, open = 0;
};

/// Numbers in binary64 and whether each is what it would be without rounding.
template <class D>
struct ExactLanes {
  hn::Vec<D> value;
  hn::Mask<D> exact;

  /// By the error of Knuth's sum.
  friend HWY_INLINE ExactLanes operator+(const ExactLanes& a, const ExactLanes& b) {
    const auto sum = hn::Add(a.value, b.value), of_b = hn::Sub(sum, a.value);
    const auto error = hn::Add(hn::Sub(a.value, hn::Sub(sum, of_b)), hn::Sub(b.value, of_b));
    return {sum, hn::And(hn::And(a.exact, b.exact), hn::Eq(error, hn::Zero(D())))};
  }
  /// Exact where the number has at most 26 bits, which Veltkamp's splitting leaves as it is.
  HWY_INLINE ExactLanes square() const {
    const auto wide = hn::Mul(value, hn::Set(D(), 0x1p27 + 1));
    const auto high = hn::Sub(wide, hn::Sub(wide, value));
    return {hn::Mul(value, value), hn::And(exact, hn::Eq(high, value))};
  }
};

/// Tells of a sphere and those of the rows whose bits are set in `asked`. Binary64 neither overflows nor
/// underflows here.
HWY_INLINE Told told_in_binary64(const Sphere& sphere, const SphereRows& rows, std::uint32_t asked) {
  using D = hn::CappedTag<double, 8>;
  using Half = hn::Rebind<float, D>;
  constexpr std::uint32_t lanes = hn::MaxLanes(D()), all = (1u << lanes) - 1;
  constexpr double binary64_slack = 1 + 10 * 0x1p-53;
  const auto slack = hn::Set(D(), binary64_slack);
  Told told;
  for (std::uint32_t begin = 0; begin < 16 && asked >> begin != 0; begin += lanes) {
    if ((asked >> begin & all) == 0) continue;
    const auto sum = [&](const float* row, float own) HWY_ATTR {
      const hn::Mask<D> yes = hn::Eq(hn::Zero(D()), hn::Zero(D()));
      return ExactLanes<D>{hn::PromoteTo(D(), hn::Load(Half(), row + begin)), yes} +
             ExactLanes<D>{hn::Set(D(), double{own}), yes};
    };
    const ExactLanes<D> q =
        sum(rows.x, -sphere.x).square() + sum(rows.y, -sphere.y).square() + sum(rows.z, -sphere.z).square();
    const ExactLanes<D> t = sum(rows.radius, sphere.radius).square();
    const auto exact = hn::And(q.exact, t.exact);
    const auto overlap =
        hn::Or(hn::Lt(hn::Mul(q.value, slack), t.value), hn::And(exact, hn::Le(q.value, t.value)));
    const auto separate =
        hn::Or(hn::Lt(hn::Mul(t.value, slack), q.value), hn::And(exact, hn::Lt(t.value, q.value)));
    const auto bits = [&](hn::Mask<D> mask) HWY_ATTR {
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(D(), mask, bytes);
      return (bytes[0] & asked >> begin & all) << begin;
    };
    told.overlap |= bits(overlap);
    told.open |= bits(hn::Not(hn::Or(overlap, separate)));
  }
  return told;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

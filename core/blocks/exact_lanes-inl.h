// What binary64 tells of several pairs of spheres that binary32 leaves open: stage 2 of Robust, and what
// of stage 3 is free of rounding.
#if defined(CATENA_CORE_BLOCKS_EXACT_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_EXACT_LANES_INL_H
#undef CATENA_CORE_BLOCKS_EXACT_LANES_INL_H
#else
#define CATENA_CORE_BLOCKS_EXACT_LANES_INL_H
#endif

#include <cstdint>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/sphere.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Bit k: pair k overlaps or touches; it is not told, and another must decide.
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

using PairTag = hn::CappedTag<double, 8>;
constexpr std::size_t pair_lanes = hn::MaxLanes(PairTag());

/// Tells of `pair_lanes` spheres and as many others, lane by lane. Binary64 neither overflows nor underflows
/// here.
HWY_INLINE Told told_in_binary64(const Sphere* some, const Sphere* others) {
  using D = PairTag;
  using Half = hn::Rebind<float, D>;
  const auto slack = hn::Set(D(), Robust::binary64_slack);
  struct Wide {
    hn::Vec<D> x, y, z, radius;
    explicit HWY_INLINE Wide(const Sphere* spheres) {
      hn::Vec<Half> fx, fy, fz, fr;
      hn::LoadInterleaved4(Half(), reinterpret_cast<const float*>(spheres), fx, fy, fz, fr);
      x = hn::PromoteTo(D(), fx), y = hn::PromoteTo(D(), fy), z = hn::PromoteTo(D(), fz);
      radius = hn::PromoteTo(D(), fr);
    }
  };
  const Wide a(some), b(others);
  const auto sum = [](hn::Vec<D> one, hn::Vec<D> other) HWY_ATTR {
    const hn::Mask<D> yes = hn::Eq(hn::Zero(D()), hn::Zero(D()));
    return ExactLanes<D>{one, yes} + ExactLanes<D>{other, yes};
  };
  const ExactLanes<D> q =
      sum(b.x, hn::Neg(a.x)).square() + sum(b.y, hn::Neg(a.y)).square() + sum(b.z, hn::Neg(a.z)).square();
  const ExactLanes<D> t = sum(b.radius, a.radius).square();
  const auto exact = hn::And(q.exact, t.exact);
  const auto overlap =
      hn::Or(hn::Lt(hn::Mul(q.value, slack), t.value), hn::And(exact, hn::Le(q.value, t.value)));
  const auto separate =
      hn::Or(hn::Lt(hn::Mul(t.value, slack), q.value), hn::And(exact, hn::Lt(t.value, q.value)));
  const auto bits = [](hn::Mask<D> mask) HWY_ATTR {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), mask, bytes);
    return bytes[0] & ((1u << pair_lanes) - 1);
  };
  return {bits(overlap), bits(hn::Not(hn::Or(overlap, separate)))};
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

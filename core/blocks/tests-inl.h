// One capsule against sixteen, and eight spheres against eight. Each says "may collide" unless it is certain.
#if defined(CATENA_CORE_BLOCKS_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_TESTS_INL_H
#undef CATENA_CORE_BLOCKS_TESTS_INL_H
#else
#define CATENA_CORE_BLOCKS_TESTS_INL_H
#endif

#include "catena/core/blocks/capsules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Bits of the lanes in which two capsules may collide. A direction is guessed, between the nearest points of
/// the two axes; only that it separates them is what counts: |t.w| - |a.w| - |b.w| > (ra + rb) |w|.
HWY_INLINE std::uint32_t may_collide(const Capsules& a, const Capsules& b) {
  const Lanes16 one = Lanes16::all(1), minus_one = Lanes16::all(-1);
  const Vectors t = b.centre - a.centre;
  const Lanes16 ta = dot(t, a.half), tb = dot(t, b.half), ab = dot(a.half, b.half), ab_b = ab * b.inverse;
  const Lanes16 sine = max(neg_mul_add(ab * a.inverse, ab_b, one), Lanes16::all(1e-4f));
  Lanes16 p = neg_mul_add(tb, ab_b, ta) * a.inverse * guess_reciprocal(sine);
  p = max(min(p, one), minus_one);
  Lanes16 q = (p * ab - tb) * b.inverse;
  q = max(min(q, one), minus_one);
  p = mul_add(q, ab, ta) * a.inverse;
  p = max(min(p, one), minus_one);
  const Vectors w = minus(plus(t, q, b.half), p, a.half);
  const Lanes16 square = dot(w, w);
  const Lanes16 gap = abs(dot(t, w)) - abs(dot(a.half, w)) - abs(dot(b.half, w));
  const Lanes16 reach = mul_add(sum_of_sides(t), Lanes16::all(BlockTree::slack), a.radius + b.radius);
  const Flags<16> separate =
      (reach * reach * square < gap * gap) & (Lanes16::all(0) < gap) & (Lanes16::all(0x1p-60f) < square);
  return ~separate.bits() & 0xFFFFu;
}

/// Bit 8 i + j: sphere i of one block may collide with, or for certain overlaps, sphere j of another.
struct SpherePairs {
  std::uint64_t may, certain;
};

/// Stage 1 of Robust, eight at a time: q = |cA - cB|^2 against t = (rA + rB)^2. Most blocks that are compared
/// have no such spheres, so that bits are made, and what is certain is asked, only where there are some.
HWY_INLINE SpherePairs sphere_pairs(const Sphere* a, const Sphere* b) {
  using Tag = Lanes8::Tag;
  Lanes8 x, y, z, r;
  for (std::size_t k = 0; k < Lanes8::parts; ++k)
    hn::LoadInterleaved4(Tag(), reinterpret_cast<const float*>(b + k * Lanes8::width), x.part[k], y.part[k],
                         z.part[k], r.part[k]);
  constexpr float overlap_slack = 1 + 12 * 0x1p-24f, overlap_floor = 0x1p-120f;
  const Lanes8 slack = Lanes8::all(overlap_slack), floor = Lanes8::all(overlap_floor);
  struct Squares {
    Lanes8 q, t;
  };
  const auto squares = [&](std::uint32_t i) -> Squares {
    const Lanes8 dx = x - Lanes8::all(a[i].x), dy = y - Lanes8::all(a[i].y), dz = z - Lanes8::all(a[i].z);
    const Lanes8 reach = r + Lanes8::all(a[i].radius);
    return {mul_add(dx, dx, mul_add(dy, dy, dz * dz)), reach * reach};
  };
  // Not less, rather than at most: a NaN of two infinities is neither, and may collide.
  Flags<8> near[BlockTree::block];
  for (std::uint32_t i = 0; i < BlockTree::block; ++i) {
    const Squares s = squares(i);
    near[i] = not_less(mul_add(s.t, slack, floor), s.q);
  }
  const Flags<8> any =
      ((near[0] | near[1]) | (near[2] | near[3])) | ((near[4] | near[5]) | (near[6] | near[7]));
  SpherePairs result{0, 0};
  if (any.none()) return result;
  for (std::uint32_t i = 0; i < BlockTree::block; ++i) {
    const std::uint64_t may = near[i].bits();
    if (may == 0) continue;
    const Squares s = squares(i);
    result.may |= may << (8 * i);
    result.certain |= std::uint64_t{(mul_add(s.q, slack, floor) < s.t).bits()} << (8 * i);
  }
  return result;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// One capsule against sixteen, and eight spheres against one. Each says "may collide" unless it is certain.
#if defined(CATENA_CORE_BLOCKS_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_TESTS_INL_H
#undef CATENA_CORE_BLOCKS_TESTS_INL_H
#else
#define CATENA_CORE_BLOCKS_TESTS_INL_H
#endif

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/capsules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Bits of the lanes in which two capsules may collide. A direction is guessed, between the nearest points of
/// the two axes; only that it separates them is what counts: |t.w| - |a.w| - |b.w| > (ra + rb) |w|.
template <std::size_t n>
HWY_INLINE std::uint32_t may_collide(const CapsulesOf<n>& a, const CapsulesOf<n>& b) {
  using L = Lanes<n>;
  L one = L::all(1), minus_one = L::all(-1);
  VectorsOf<n> t = b.centre - a.centre;
  L ta = dot(t, a.half), tb = dot(t, b.half), ab = dot(a.half, b.half), ab_b = ab * b.inverse;
  L sine = max(neg_mul_add(ab * a.inverse, ab_b, one), L::all(1e-4f));
  L p = neg_mul_add(tb, ab_b, ta) * a.inverse * guess_reciprocal(sine);
  p = max(min(p, one), minus_one);
  L q = (p * ab - tb) * b.inverse;
  q = max(min(q, one), minus_one);
  p = mul_add(q, ab, ta) * a.inverse;
  p = max(min(p, one), minus_one);
  VectorsOf<n> w = minus(plus(t, q, b.half), p, a.half);
  // Where no product underflows: squares that are compared are above `least`, and so the gap above 2^-49. By
  // three times 2^-98 it is wrong then, less than 2^-47 of itself.
  L least = L::all(0x1p-98f), no_gap = L::all(0x1p-50f);
  L square = dot(w, w, least);
  L gap = max(abs(dot(t, w, least)) - abs(dot(a.half, w, least)) - abs(dot(b.half, w, least)), no_gap);
  L reach = mul_add(sum_of_sides(t), L::all(BlockTree::slack), a.radius + b.radius);
  Flags<n> separate = mul_add(mul_add(reach, reach, least), square, least) < gap * gap;
  return ~separate.bits() & (~0u >> (32 - n));
}

/// The same among `lanes` only, vector by vector: where sixteen lanes take several, most of a row's are in
/// one, and two at once would not fit the registers.
HWY_INLINE std::uint32_t may_collide(const CapsulesOf<16>& a, const CapsulesOf<16>& b, std::uint32_t lanes) {
  constexpr std::size_t width = Lanes16::width;
  std::uint32_t near = 0;
#if HWY_TARGET == HWY_SCALAR
#pragma GCC unroll 1
#endif
  for (std::size_t k = 0; k < Lanes16::parts; ++k)
    if ((lanes >> (k * width) & (~0u >> (32 - width))) != 0)
      near |= may_collide(part_of<width>(a, k), part_of<width>(b, k)) << (k * width);
  return near & lanes;
}

/// Eight spheres, against which others are tested: stage 1 of Robust, q = |cA - cB|^2 against
/// t = (rA + rB)^2.
class SphereLanes {
 public:
  struct Squares {
    Lanes8 q, t;
  };

  explicit HWY_INLINE SphereLanes(const Sphere* spheres) {
    using Tag = Lanes8::Tag;
    for (std::size_t k = 0; k < Lanes8::parts; ++k)
      hn::LoadInterleaved4(Tag(), reinterpret_cast<const float*>(spheres + k * Lanes8::width), x_.part[k],
                           y_.part[k], z_.part[k], radius_.part[k]);
  }

  HWY_INLINE Squares squares(const Sphere& s) const {
    Lanes8 dx = x_ - Lanes8::all(s.x), dy = y_ - Lanes8::all(s.y), dz = z_ - Lanes8::all(s.z);
    Lanes8 reach = radius_ + Lanes8::all(s.radius);
    return {mul_add(dx, dx, mul_add(dy, dy, dz * dz)), reach * reach};
  }
  /// Not less, rather than at most: a NaN of two infinities is neither, and may overlap.
  static HWY_INLINE Flags<8> may_overlap(const Squares& s) {
    return not_less(mul_add(s.t, Lanes8::all(Robust::binary32_slack), Lanes8::all(Robust::underflow_floor)),
                    s.q);
  }
  static HWY_INLINE Flags<8> overlap_for_certain(const Squares& s) {
    return mul_add(s.q, Lanes8::all(Robust::binary32_slack), Lanes8::all(Robust::underflow_floor)) < s.t;
  }

  /// Which of the centres lie in a cube around that of `s`, which reaches so many times to either side as far
  /// as it and the other do.
  HWY_INLINE std::uint32_t centres_within(const Sphere& s, float times) const {
    Lanes8 far = Lanes8::all(times) * (radius_ + Lanes8::all(s.radius));
    Flags<8> within = (abs(x_ - Lanes8::all(s.x)) <= far) & (abs(y_ - Lanes8::all(s.y)) <= far) &
                      (abs(z_ - Lanes8::all(s.z)) <= far);
    return within.bits();
  }

 private:
  Lanes8 x_, y_, z_, radius_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

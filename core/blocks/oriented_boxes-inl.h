// Boxes along axes of their own: nodes of blocks in them, and tests of one against sixteen.
#if defined(CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H
#undef CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H
#else
#define CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H
#endif

#include "catena/core/blocks/principal_axes-inl.h"
#include "catena/core/blocks/tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Slack of intervals for the way from a centre to another, relative to the sum of its sides.
constexpr float centre_slack = 0x1p-20f;  // 16 u

/// How far things reach along three axes, from a box's centre: sixteen things, or one in all lanes.
struct Intervals {
  Lanes16 low[3], high[3];
};

/// The points p with |(p - centre) . axis| <= half for each of three axes, which are orthonormal to within
/// axes_error.
struct OrientedBoxes {
  static constexpr std::uint32_t fields = BlockTree::oriented_fields;
  Vectors centre, axis[3];
  Lanes16 half[3];

  static HWY_INLINE OrientedBoxes load(const float* f) {
    return {Vectors::load(f),
            {Vectors::load(f + 48), Vectors::load(f + 96), Vectors::load(f + 144)},
            {Lanes16::load(f + 192), Lanes16::load(f + 208), Lanes16::load(f + 224)}};
  }
  static HWY_INLINE OrientedBoxes all(const float* f, std::uint32_t lane) {
    return {Vectors::all(f, lane),
            {Vectors::all(f + 48, lane), Vectors::all(f + 96, lane), Vectors::all(f + 144, lane)},
            {Lanes16::all(f[192 + lane]), Lanes16::all(f[208 + lane]), Lanes16::all(f[224 + lane])}};
  }
  HWY_INLINE void store(float* f) const {
    centre.store(f);
    for (int k = 0; k < 3; ++k) axis[k].store(f + 48 + 48 * k), half[k].store(f + 192 + 16 * k);
  }
};

/// How far they reach along one.
struct Interval {
  Lanes16 low, high;
};

/// How far capsules reach along the axes, outward: what the radius has on top covers the rounding of the half
/// axis's part, the rest that of the centre's, of the sums, and of axes a little longer than 1.
class CapsuleReach {
 public:
  HWY_INLINE CapsuleReach(const Capsules& c, const Vectors& centre)
      : c_(c),
        t_(c.centre - centre),
        radius_(mul_add(sum_of_sides(t_), Lanes16::all(centre_slack),
                        c.radius * Lanes16::all(1 + BlockTree::axes_slack))) {}
  HWY_INLINE Interval along(const Vectors& axis) const {
    Lanes16 middle = dot(t_, axis), reach = abs(dot(c_.half, axis)) + radius_;
    return {middle - reach, middle + reach};
  }

 private:
  const Capsules& c_;
  const Vectors t_;
  const Lanes16 radius_;
};

/// The same of boxes: see may_meet.
class BoxReach {
 public:
  HWY_INLINE BoxReach(const OrientedBoxes& b, const Vectors& centre)
      : b_(b),
        t_(b.centre - centre),
        slack_(
            mul_add(b.half[0] + b.half[1] + b.half[2], Lanes16::all(BlockTree::axes_slack),
                    mul_add(sum_of_sides(t_), Lanes16::all(centre_slack), Lanes16::all(BlockTree::tiny)))) {}
  HWY_INLINE Interval along(const Vectors& axis) const {
    Lanes16 middle = dot(t_, axis);
    Lanes16 reach = slack_;
    for (int j = 0; j < 3; ++j) reach = mul_add(abs(dot(b_.axis[j], axis)), b_.half[j], reach);
    return {middle - reach, middle + reach};
  }

 private:
  const OrientedBoxes& b_;
  const Vectors t_;
  const Lanes16 slack_;
};

HWY_INLINE CapsuleReach reach_of(const Capsules& c, const Vectors& centre) { return {c, centre}; }
HWY_INLINE BoxReach reach_of(const OrientedBoxes& b, const Vectors& centre) { return {b, centre}; }

template <class Sixteen>
HWY_INLINE Intervals intervals(const Sixteen& of, const Vectors& centre, const Vectors (&axis)[3]) {
  auto reach = reach_of(of, centre);
  Interval x = reach.along(axis[0]), y = reach.along(axis[1]), z = reach.along(axis[2]);
  return {{x.low, y.low, z.low}, {x.high, y.high, z.high}};
}

/// Bits of the lanes in which intervals meet along all three axes; exact.
HWY_INLINE std::uint32_t meet(const Intervals& a, const Intervals& b) {
  Flags<16> x = (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]);
  Flags<16> y = (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]);
  Flags<16> z = (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
  return (x & y & z).bits();
}

/// Intervals of sixteen, kept to take single ones out.
struct StoredIntervals {
  alignas(64) float low[3][16], high[3][16];
  StoredIntervals() = default;
  explicit HWY_INLINE StoredIntervals(const Intervals& of) {
    for (int k = 0; k < 3; ++k) of.low[k].store(low[k]), of.high[k].store(high[k]);
  }
  HWY_INLINE Intervals all(std::uint32_t lane) const {
    Intervals result;
    for (int k = 0; k < 3; ++k)
      result.low[k] = Lanes16::all(low[k][lane]), result.high[k] = Lanes16::all(high[k][lane]);
    return result;
  }
};

/// Bits of the lanes whose intervals, along a box's own axes, meet it; exact.
HWY_INLINE std::uint32_t meet(const Intervals& a, const Lanes16 (&half)[3]) {
  Lanes16 zero = Lanes16::all(0);
  Flags<16> x = (a.low[0] <= half[0]) & (zero - half[0] <= a.high[0]);
  Flags<16> y = (a.low[1] <= half[1]) & (zero - half[1] <= a.high[1]);
  Flags<16> z = (a.low[2] <= half[2]) & (zero - half[2] <= a.high[2]);
  return (x & y & z).bits();
}

/// Bits of the lanes in which boxes may have a point in common. A box reaches sum |v_j . u| half_j along u,
/// and for axes that are orthonormal but for axes_error, axes_slack times sum half_j more.
HWY_INLINE std::uint32_t may_meet(const OrientedBoxes& a, const OrientedBoxes& b) {
  Vectors t = b.centre - a.centre;
  Lanes16 slack = Lanes16::all(BlockTree::axes_slack);
  Lanes16 rounding = mul_add(sum_of_sides(t), Lanes16::all(centre_slack), Lanes16::all(BlockTree::tiny));
  Lanes16 sides_a = mul_add(a.half[0] + a.half[1] + a.half[2], slack, rounding);
  Lanes16 sides_b = mul_add(b.half[0] + b.half[1] + b.half[2], slack, rounding);
  Lanes16 reach_b[3] = {b.half[0] + sides_a, b.half[1] + sides_a, b.half[2] + sides_a};
  Flags<16> meeting = t.x <= t.x;
  for (int k = 0; k < 3; ++k) {
    Lanes16 reach = a.half[k] + sides_b;
    for (int j = 0; j < 3; ++j) {
      Lanes16 cosine = abs(dot(a.axis[k], b.axis[j]));
      reach = mul_add(cosine, b.half[j], reach);
      reach_b[j] = mul_add(cosine, a.half[k], reach_b[j]);
    }
    meeting = meeting & (abs(dot(t, a.axis[k])) <= reach);
  }
  for (int j = 0; j < 3; ++j) meeting = meeting & (abs(dot(t, b.axis[j])) <= reach_b[j]);
  return meeting.bits();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

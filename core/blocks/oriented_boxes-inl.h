// Boxes along axes of their own: nodes of blocks in them, and tests of one against sixteen.
#if defined(CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H
#undef CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H
#else
#define CATENA_CORE_BLOCKS_ORIENTED_BOXES_INL_H
#endif

#include <limits>

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

/// How far capsules reach along the axes, outward: what the radius has on top covers the rounding of the half
/// axis's part, the rest that of the centre's, of the sums, and of axes a little longer than 1.
HWY_INLINE Intervals intervals(const Capsules& c, const Vectors& centre, const Vectors (&axis)[3]) {
  const Vectors t = c.centre - centre;
  const Lanes16 radius = mul_add(sum_of_sides(t), Lanes16::all(centre_slack),
                                 c.radius * Lanes16::all(1 + BlockTree::axes_slack));
  Intervals result;
  for (int k = 0; k < 3; ++k) {
    const Lanes16 middle = dot(t, axis[k]), reach = abs(dot(c.half, axis[k])) + radius;
    result.low[k] = middle - reach, result.high[k] = middle + reach;
  }
  return result;
}

/// The same of boxes: see may_meet.
HWY_INLINE Intervals intervals(const OrientedBoxes& b, const Vectors& centre, const Vectors (&axis)[3]) {
  const Vectors t = b.centre - centre;
  const Lanes16 slack =
      mul_add(b.half[0] + b.half[1] + b.half[2], Lanes16::all(BlockTree::axes_slack),
              mul_add(sum_of_sides(t), Lanes16::all(centre_slack), Lanes16::all(BlockTree::tiny)));
  Intervals result;
  for (int k = 0; k < 3; ++k) {
    const Lanes16 middle = dot(t, axis[k]);
    Lanes16 reach = slack;
    for (int j = 0; j < 3; ++j) reach = mul_add(abs(dot(b.axis[j], axis[k])), b.half[j], reach);
    result.low[k] = middle - reach, result.high[k] = middle + reach;
  }
  return result;
}

/// Bits of the lanes in which intervals meet along all three axes; exact.
HWY_INLINE std::uint32_t meet(const Intervals& a, const Intervals& b) {
  const Flags<16> x = (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]);
  const Flags<16> y = (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]);
  const Flags<16> z = (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
  return (x & y & z).bits();
}

/// Certain that of the first `count` none meets the next but one, or a later one: along the longest axis they
/// follow one another, one way or the other.
HWY_INLINE bool in_a_row(const Intervals& a, std::uint32_t count) {
  if (count < 3) return true;
  const auto& low = a.low[0];
  const auto& high = a.high[0];
  const Lanes16 low_1 = shifted(low, 0), high_1 = shifted(high, 0);
  const Lanes16 low_2 = shifted(low_1, 0), high_2 = shifted(high_1, 0);
  const std::uint32_t next = (1u << (count - 1)) - 1, next_but_one = next >> 1;
  const std::uint32_t up = (high < low_2).bits() & next_but_one, rising = (low <= low_1).bits() & next;
  const std::uint32_t down = (high_2 < low).bits() & next_but_one, falling = (high_1 <= high).bits() & next;
  return (up == next_but_one && rising == next) || (down == next_but_one && falling == next);
}

/// Intervals of sixteen, kept to take single ones out.
struct StoredIntervals {
  alignas(64) float low[3][16], high[3][16];
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

/// The box's own.
HWY_INLINE Intervals intervals(const Lanes16 (&half)[3]) {
  const Lanes16 zero = Lanes16::all(0);
  return {{zero - half[0], zero - half[1], zero - half[2]}, {half[0], half[1], half[2]}};
}

/// Bits of the lanes in which boxes may have a point in common. A box reaches sum |v_j . u| half_j along u,
/// and for axes that are orthonormal but for axes_error, axes_slack times sum half_j more.
HWY_INLINE std::uint32_t may_meet(const OrientedBoxes& a, const OrientedBoxes& b) {
  const Vectors t = b.centre - a.centre;
  const Lanes16 slack = Lanes16::all(BlockTree::axes_slack);
  const Lanes16 rounding =
      mul_add(sum_of_sides(t), Lanes16::all(centre_slack), Lanes16::all(BlockTree::tiny));
  const Lanes16 sides_a = mul_add(a.half[0] + a.half[1] + a.half[2], slack, rounding);
  const Lanes16 sides_b = mul_add(b.half[0] + b.half[1] + b.half[2], slack, rounding);
  Lanes16 reach_b[3] = {b.half[0] + sides_a, b.half[1] + sides_a, b.half[2] + sides_a};
  Flags<16> meeting = t.x <= t.x;
  for (int k = 0; k < 3; ++k) {
    Lanes16 reach = a.half[k] + sides_b;
    for (int j = 0; j < 3; ++j) {
      const Lanes16 cosine = abs(dot(a.axis[k], b.axis[j]));
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

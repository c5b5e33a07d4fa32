#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#include "catena/core/arithmetic/mul_add.h"
#include "catena/core/blocks/block_tree.h"
#include "catena/core/cells/bits.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// Three numbers in binary32: a point, or a way from one to another.
struct Vector32 {
  float x, y, z;
  CATENA_HD friend Vector32 operator+(const Vector32& a, const Vector32& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  CATENA_HD friend Vector32 operator-(const Vector32& a, const Vector32& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

/// a . b.
CATENA_HD inline float dot(const Vector32& a, const Vector32& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
/// t a.
CATENA_HD inline Vector32 operator*(float t, const Vector32& a) { return {t * a.x, t * a.y, t * a.z}; }
/// a + t b.
CATENA_HD inline Vector32 plus(const Vector32& a, float t, const Vector32& b) {
  return {mul_add(t, b.x, a.x), mul_add(t, b.y, a.y), mul_add(t, b.z, a.z)};
}
/// |x| + |y| + |z|: at least the length, and at most sqrt(3) times it.
CATENA_HD inline float sum_of_sides(const Vector32& a) {
  return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z);
}
/// The nearest number of [-1, 1].
CATENA_HD inline float clamped(float t) { return t < -1 ? -1.0f : t > 1 ? 1.0f : t; }
/// Where a sphere's centre is.
CATENA_HD inline Vector32 centre_of(const Sphere& s) { return {s.x, s.y, s.z}; }

/// All points within `radius` of centre +- half: what the blocks of a chain lie in, with the formulas, slacks
/// and units of core/blocks/ (BlockTree; capsule_binary32.g), one capsule at a time.
struct alignas(16) BlockCapsule {
  Vector32 centre;
  float radius;
  Vector32 half;
  float reach;  ///< |half| + radius

  /// What a capsule and its tests lose by underflow is less. In units of their own squares lose nothing.
  CATENA_HD static float tiny_of(bool own_units) { return own_units ? BlockTree::tiny : 0x1p-28f; }

  CATENA_HD static float inverse_square(float square) {
    constexpr float least_square = 0x1p-60f;
    return least_square < square ? 1 / square : 0;
  }
  /// The radius with what its own rounding and that of every test of it need on top, but for what is lost by
  /// underflow.
  CATENA_HD static float with_slack(float radius, float half_square) {
    const float reach = std::sqrt(half_square) + radius;
    return mul_add(reach, BlockTree::slack, radius);
  }
  CATENA_HD static BlockCapsule around(const Sphere& s, bool own_units) {
    const float radius = with_slack(s.radius, 0) + tiny_of(own_units);
    return {centre_of(s), radius, {0, 0, 0}, radius};
  }
};

/// The power of two that brings a length to 1 .. 2, 2^127 for lengths that are less than 2^-126. A product
/// with it is exact where it does not overflow.
CATENA_HD inline float unit_of(float length) {
  std::uint32_t bits;
  std::memcpy(&bits, &length, sizeof bits);
  return power_of_two(127 - static_cast<std::int32_t>(bits >> 23 & 0xFF));
}

/// The ball about a capsule's centre that holds it.
struct alignas(16) CapsuleBall {
  Vector32 centre;
  float reach;
};
/// That of a capsule.
CATENA_HD inline CapsuleBall ball_of(const BlockCapsule& c) { return {c.centre, c.reach}; }

/// True only when nothing in one capsule touches anything in the other, as their centres are too far apart.
/// In a unit of their own the way from one to the other is about 1, and no square of what matters is lost;
/// what is infinite then is not apart.
CATENA_HD inline bool far_apart(const CapsuleBall& a, const CapsuleBall& b, bool own_units) {
  Vector32 t = b.centre - a.centre;
  float reach = a.reach + b.reach;
  if (own_units) {
    const float unit = unit_of(sum_of_sides(t));
    t = unit * t, reach *= unit;
  }
  return dot(t, t) > reach * reach;
}

/// True only when nothing in one capsule touches anything in the other. A direction is guessed, between the
/// nearest points of the two axes; only that it separates them is what counts: |t.w| - |a.w| - |b.w| > (ra +
/// rb) |w|. In a unit of their own as far_apart.
CATENA_HD inline bool separate(const BlockCapsule& first, const BlockCapsule& second, bool own_units) {
  Vector32 t = second.centre - first.centre, a = first.half, b = second.half;
  float radii = first.radius + second.radius;
  if (own_units) {
    const float unit = unit_of(sum_of_sides(t));
    t = unit * t, a = unit * a, b = unit * b, radii *= unit;
  }
  const float over_a = BlockCapsule::inverse_square(dot(a, a)),
              over_b = BlockCapsule::inverse_square(dot(b, b));
  const float ta = dot(t, a), tb = dot(t, b), ab = dot(a, b), ab_b = ab * over_b;
  const float sine = std::fmax(1 - ab * over_a * ab_b, 1e-4f);
  float p = clamped((ta - tb * ab_b) * over_a / sine);
  const float q = clamped((p * ab - tb) * over_b);
  p = clamped((q * ab + ta) * over_a);
  const Vector32 w = plus(plus(t, q, b), -p, a);
  const float square = dot(w, w);
  const float gap = std::fabs(dot(t, w)) - std::fabs(dot(a, w)) - std::fabs(dot(b, w));
  const float reach = mul_add(sum_of_sides(t), BlockTree::slack, radii);
  return gap > 0 && square > 0x1p-60f && gap * gap > reach * reach * square;
}

}  // namespace catena

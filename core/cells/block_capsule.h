#pragma once
#include <cmath>
#include <cstdint>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

struct Vector32 {
  float x, y, z;
  CATENA_HD friend Vector32 operator+(const Vector32& a, const Vector32& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  CATENA_HD friend Vector32 operator-(const Vector32& a, const Vector32& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

/// a b + c, rounded once on a device and twice on the host: the proofs are of both.
CATENA_HD inline float mul_add(float a, float b, float c) {
#ifdef __CUDA_ARCH__
  return fmaf(a, b, c);
#else
  return a * b + c;
#endif
}
CATENA_HD inline float dot(const Vector32& a, const Vector32& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
/// a + t b.
CATENA_HD inline Vector32 plus(const Vector32& a, float t, const Vector32& b) {
  return {mul_add(t, b.x, a.x), mul_add(t, b.y, a.y), mul_add(t, b.z, a.z)};
}
CATENA_HD inline float sum_of_sides(const Vector32& a) {
  return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z);
}
CATENA_HD inline float clamped(float t) { return t < -1 ? -1.0f : t > 1 ? 1.0f : t; }
CATENA_HD inline Vector32 centre_of(const Sphere& s) { return {s.x, s.y, s.z}; }

/// All points within `radius` of centre +- half: what the blocks of a chain lie in, with the formulas, slacks
/// and units of core/blocks/ (BlockTree; capsule_binary32.g), one capsule at a time.
struct alignas(16) BlockCapsule {
  Vector32 centre;
  float radius;
  Vector32 half;
  float reach;  ///< |half| + radius

  CATENA_HD static float inverse_square(float square) {
    constexpr float least_square = 0x1p-60f;
    return least_square < square ? 1 / square : 0;
  }
  /// The radius with what its own rounding and that of every test of it need on top.
  CATENA_HD static float with_slack(float radius, float half_square) {
    const float reach = std::sqrt(half_square) + radius;
    return mul_add(reach, BlockTree::slack, radius) + BlockTree::tiny;
  }
  CATENA_HD static BlockCapsule around(const Sphere& s) {
    const float radius = with_slack(s.radius, 0);
    return {centre_of(s), radius, {0, 0, 0}, radius};
  }
};

/// True only when nothing in one capsule touches anything in the other, as their centres are too far apart.
CATENA_HD inline bool far_apart(const BlockCapsule& a, const BlockCapsule& b) {
  const Vector32 t = b.centre - a.centre;
  const float reach = a.reach + b.reach;
  return dot(t, t) > reach * reach;
}

/// True only when nothing in one capsule touches anything in the other. A direction is guessed, between the
/// nearest points of the two axes; only that it separates them is what counts: |t.w| - |a.w| - |b.w| > (ra +
/// rb) |w|.
CATENA_HD inline bool separate(const BlockCapsule& a, const BlockCapsule& b) {
  const Vector32 t = b.centre - a.centre;
  const float over_a = BlockCapsule::inverse_square(dot(a.half, a.half)),
              over_b = BlockCapsule::inverse_square(dot(b.half, b.half));
  const float ta = dot(t, a.half), tb = dot(t, b.half), ab = dot(a.half, b.half), ab_b = ab * over_b;
  const float sine = std::fmax(1 - ab * over_a * ab_b, 1e-4f);
  float p = clamped((ta - tb * ab_b) * over_a / sine);
  const float q = clamped((p * ab - tb) * over_b);
  p = clamped((q * ab + ta) * over_a);
  const Vector32 w = plus(plus(t, q, b.half), -p, a.half);
  const float square = dot(w, w);
  const float gap = std::fabs(dot(t, w)) - std::fabs(dot(a.half, w)) - std::fabs(dot(b.half, w));
  const float reach = mul_add(sum_of_sides(t), BlockTree::slack, a.radius + b.radius);
  return gap > 0 && square > 0x1p-60f && gap * gap > reach * reach * square;
}

/// The spheres of a block and of the one after it, in lanes, and what a warp makes of them.
template <class Warp>
struct BlockPair {
  using Spheres = typename Warp::template Lanes<Sphere>;
  const Warp& warp;
  const Spheres &own, &next;
  Sphere first, middle, after_middle, last,
      next_last;  ///< spheres 0, 15, 16, 31 of the block, 31 of the next

  /// About the chord from first to last, moved half way to the middle of the arc.
  CATENA_HD BlockCapsule capsule() const {
    const Vector32 origin = centre_of(first), chord = centre_of(last) - origin;
    const Vector32 arc = (centre_of(middle) - origin) + (centre_of(after_middle) - origin);
    BlockCapsule result{};
    result.half = {0.5f * chord.x, 0.5f * chord.y, 0.5f * chord.z};
    result.centre = plus(plus(origin, 0.5f, result.half), 0.25f, arc);
    const float half_square = dot(result.half, result.half), over = BlockCapsule::inverse_square(half_square);
    // The square of how far a sphere lies from the axis, from above but for rounding: the point of the axis
    // is a guess, and any point of it will do.
    const float farthest = warp.greatest([&](std::uint32_t lane) {
      const Vector32 p = centre_of(own[lane]) - result.centre;
      const Vector32 rest = plus(p, -clamped(dot(p, result.half) * over), result.half);
      return dot(rest, rest);
    });
    const float thickest = warp.greatest([&](std::uint32_t lane) { return own[lane].radius; });
    result.radius = BlockCapsule::with_slack(std::sqrt(farthest) + thickest, half_square);
    result.reach = std::sqrt(half_square) + result.radius;
    return result;
  }

  /// True only when no sphere of this block collides with another of this block or the next but one next to
  /// it: along the direction from the first to the last, of a length at most `length`, sphere i lies at s_i;
  /// where s rises by more than two greatest radii times length from i to i + 2, and does not fall from i to
  /// i + 1 in this block, it rises by more than that to every sphere after i + 1. The slack is for the
  /// rounding of s and of the sums.
  CATENA_HD bool ordered(const BlockCapsule& capsule) const {
    const Vector32 direction = centre_of(next_last) - centre_of(first);
    const float length = std::sqrt(dot(direction, direction)) * (1 + 0x1p-16f);
    const float thickest = warp.greatest([&](std::uint32_t lane) {
      return own[lane].radius < next[lane].radius ? next[lane].radius : own[lane].radius;
    });
    const float beyond = warp.greatest(
        [&](std::uint32_t lane) { return sum_of_sides(centre_of(next[lane]) - capsule.centre); });
    const float far = (beyond < capsule.reach ? capsule.reach : beyond) + thickest;
    const float step = 2 * thickest * length + (length * far * BlockTree::slack + 0x1p-60f);
    const auto along = [&](const Spheres& of) {
      return warp.each(
          [&](std::uint32_t lane) { return dot(centre_of(of[lane]) - capsule.centre, direction); });
    };
    const auto s = along(own), s_next = along(next);
    const auto one_on = warp.ahead(s, s_next, 1), two_on = warp.ahead(s, s_next, 2),
               two_on_next = warp.ahead(s_next, s_next, 2);
    const std::uint32_t fails = warp.ballot([&](std::uint32_t lane) {
      const bool rises = s[lane] <= one_on[lane];
      const bool apart =
          s[lane] + step < two_on[lane] && (lane >= 30 || s_next[lane] + step < two_on_next[lane]);
      return !(rises && apart);
    });
    return fails == 0;
  }
};

}  // namespace catena

// Capsules of sixteen blocks at once, lane = block.
#if defined(CATENA_CORE_BLOCKS_CAPSULES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_CAPSULES_INL_H
#undef CATENA_CORE_BLOCKS_CAPSULES_INL_H
#else
#define CATENA_CORE_BLOCKS_CAPSULES_INL_H
#endif

#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// All points within `radius` of centre +- half axis, a lane.
template <std::size_t n>
struct CapsulesOf {
  VectorsOf<n> centre, half;
  Lanes<n> radius, inverse;  ///< inverse: about 1 / |half|^2; 0 for a point
};

struct Capsules : CapsulesOf<16> {
  static constexpr std::uint32_t fields = BlockTree::capsule_fields;

  static HWY_INLINE Capsules load(const float* f) {
    return {{Vectors::load(f), Vectors::load(f + 48), Lanes16::load(f + 96), Lanes16::load(f + 112)}};
  }
  static HWY_INLINE Capsules all(const float* f, std::uint32_t lane) {
    return {{Vectors::all(f, lane), Vectors::all(f + 48, lane), Lanes16::all(f[96 + lane]),
             Lanes16::all(f[112 + lane])}};
  }
  /// Lane k is of the fields that lie one after another at row(k).
  template <class Row>
  static HWY_INLINE Capsules of_rows(const Row& row) {
    static_assert(fields == 8);
    Lanes16 a[4], b[4];
    transpose_rows(row, a);
    transpose_rows([&](std::size_t k) { return row(k) + 4; }, b);
    return {{{a[0], a[1], a[2]}, {a[3], b[0], b[1]}, b[2], b[3]}};
  }
  HWY_INLINE void store(float* f) const {
    centre.store(f), half.store(f + 48), radius.store(f + 96), inverse.store(f + 112);
  }
};
template <std::size_t n>
HWY_INLINE CapsulesOf<2 * n> side_by_side(const CapsulesOf<n>& a, const CapsulesOf<n>& b) {
  return {side_by_side(a.centre, b.centre), side_by_side(a.half, b.half), side_by_side(a.radius, b.radius),
          side_by_side(a.inverse, b.inverse)};
}

/// Vector k of those that the lanes take.
template <std::size_t width, std::size_t n>
HWY_INLINE CapsulesOf<width> part_of(const CapsulesOf<n>& a, std::size_t k) {
  const auto of = [k](const Lanes<n>& lanes)
                      HWY_ATTR { return Lanes<width>::from([&](std::size_t) { return lanes.part[k]; }); };
  const auto vectors = [&](const VectorsOf<n>& v) HWY_ATTR {
    return VectorsOf<width>{of(v.x), of(v.y), of(v.z)};
  };
  return {vectors(a.centre), vectors(a.half), of(a.radius), of(a.inverse)};
}

/// What squares of lengths within a block have on top, so that none underflows; and the least reach of a
/// block beside which that is nothing.
constexpr float least_square = 0x1p-80f, least_reach = 0x1p-36f;

HWY_INLINE Lanes16 inverse_square(const Lanes16& square) {
  Lanes16 of_a_point = Lanes16::all(4 * least_square);
  return select(of_a_point < square, Lanes16::all(1) / max(square, of_a_point), Lanes16::all(0));
}

/// The square of how far a point p lies from the segment +- half, from above but for rounding: the point of
/// the segment is a guess, and any point of it will do.
HWY_INLINE Lanes16 distance_to_segment(const Vectors& p, const Vectors& half, const Lanes16& inverse) {
  Lanes16 one = Lanes16::all(1), least = Lanes16::all(least_square);
  Lanes16 t = max(min(dot(p, half, least) * inverse, one), Lanes16::all(-1));
  Vectors rest = minus(p, t, half);
  return dot(rest, rest, least);
}

/// The radius with what its own rounding and that of every test of it need on top.
HWY_INLINE Lanes16 with_slack(const Lanes16& radius, const Lanes16& half_length) {
  Lanes16 reach = half_length + radius;
  return mul_add(reach, Lanes16::all(BlockTree::slack), radius) + Lanes16::all(BlockTree::tiny);
}

/// Spheres of sixteen blocks, lane = block: [place in the block].
struct BlockSpheres {
  Vectors at[BlockTree::block];
  Lanes16 radius[BlockTree::block];
};

/// Sixteen blocks that follow one another from `spheres` on, times scale.
HWY_INLINE void load(const Sphere* spheres, const Lanes16& scale, BlockSpheres& blocks) {
  static_assert(sizeof(Sphere) == 4 * sizeof(float));
  constexpr std::uint32_t block = BlockTree::block;
  for (std::uint32_t j = 0; j < block; ++j) {
    Lanes16 field[4];
    transpose(&spheres[j].x, 4 * block, field);
    blocks.at[j] = {field[0] * scale, field[1] * scale, field[2] * scale};
    blocks.radius[j] = field[3] * scale;
  }
}

/// At least how far the centres lie from these points, without a square.
HWY_INLINE Lanes16 sides_around(const BlockSpheres& s, const Vectors& points) {
  Lanes16 farthest = Lanes16::all(0);
  for (const Vectors& at : s.at) farthest = max(farthest, sum_of_sides(at - points));
  return farthest;
}

/// Capsules around the spheres, about the chord from first to last, moved half way to the middle of the arc;
/// balls, where squares say nothing.
/// `reach` becomes a bound of |centre of sphere - centre| + radius.
HWY_INLINE Capsules capsules_around(const BlockSpheres& s, Lanes16& reach) {
  constexpr std::uint32_t last = BlockTree::block - 1;
  Lanes16 half = Lanes16::all(0.5f), quarter = Lanes16::all(0.25f);
  Vectors chord = s.at[last] - s.at[0];
  Capsules result;
  result.half = {chord.x * half, chord.y * half, chord.z * half};
  Vectors middle = (s.at[last / 2] - s.at[0]) + (s.at[last / 2 + 1] - s.at[0]);
  result.centre = plus(plus(s.at[0], half, result.half), quarter, middle);
  Lanes16 half_square = dot(result.half, result.half, Lanes16::all(least_square));
  result.inverse = inverse_square(half_square);
  Lanes16 farthest = Lanes16::all(0), thickest = s.radius[0];
  for (std::uint32_t j = 0; j <= last; ++j) {
    farthest = max(farthest, distance_to_segment(s.at[j] - result.centre, result.half, result.inverse));
    thickest = max(thickest, s.radius[j]);
  }
  farthest = sqrt(farthest);
  Lanes16 length = sqrt(half_square);
  Flags<16> small = length + (farthest + thickest) < Lanes16::all(least_reach);
  if (HWY_UNLIKELY(!small.none())) {
    Lanes16 zero = Lanes16::all(0);
    farthest = select(small, sides_around(s, result.centre), farthest);
    length = select(small, zero, length);
    result.half = select(small, {zero, zero, zero}, result.half);
    result.inverse = select(small, zero, result.inverse);
  }
  result.radius = with_slack(farthest + thickest, length);
  reach = length + result.radius;
  return result;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

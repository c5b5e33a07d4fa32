// Capsules of sixteen blocks at once, lane = block.
#if defined(CATENA_CORE_BLOCKS_CAPSULES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_CAPSULES_INL_H
#undef CATENA_CORE_BLOCKS_CAPSULES_INL_H
#else
#define CATENA_CORE_BLOCKS_CAPSULES_INL_H
#endif

#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// All points within `radius` of centre +- half axis, a lane.
struct Capsules {
  Vectors centre, half;
  Lanes16 radius, inverse;  ///< inverse: about 1 / |half|^2; 0 for a point

  static HWY_INLINE Capsules load(const float* fields) {
    return {Vectors::load(fields), Vectors::load(fields + 48), Lanes16::load(fields + 96),
            Lanes16::load(fields + 112)};
  }
  static HWY_INLINE Capsules all(const float* fields, std::uint32_t lane) {
    return {Vectors::all(fields, lane), Vectors::all(fields + 48, lane), Lanes16::all(fields[96 + lane]),
            Lanes16::all(fields[112 + lane])};
  }
  HWY_INLINE void store(float* fields) const {
    centre.store(fields), half.store(fields + 48), radius.store(fields + 96), inverse.store(fields + 112);
  }
};

HWY_INLINE Lanes16 inverse_square(const Lanes16& square) {
  const Lanes16 least_square = Lanes16::all(0x1p-60f);
  return select(least_square < square, Lanes16::all(1) / max(square, least_square), Lanes16::all(0));
}

/// How far a point p lies from the segment +- half, from above but for rounding: the point of the segment is
/// a guess, and any point of it will do.
HWY_INLINE Lanes16 distance_to_segment(const Vectors& p, const Vectors& half, const Lanes16& inverse) {
  const Lanes16 one = Lanes16::all(1);
  const Lanes16 t = max(min(dot(p, half) * inverse, one), Lanes16::all(-1));
  const Vectors rest = minus(p, t, half);
  return dot(rest, rest);
}

/// The radius with what its own rounding and that of every test of it need on top.
HWY_INLINE Lanes16 with_slack(const Lanes16& radius, const Lanes16& half_square) {
  const Lanes16 reach = sqrt(half_square) + radius;
  return mul_add(reach, Lanes16::all(BlockTree::slack), radius) + Lanes16::all(BlockTree::tiny);
}

/// Spheres of sixteen blocks, lane = block: [place in the block].
struct BlockSpheres {
  Vectors at[BlockTree::block];
  Lanes16 radius[BlockTree::block];
};

#if HWY_TARGET != HWY_SCALAR  // which has no vectors to shuffle
/// Four floats each of as many spheres as a vector has quads, `stride` spheres apart.
template <class Tag>
HWY_INLINE hn::Vec<Tag> quads(Tag tag, const Sphere* first, std::size_t stride) {
  if constexpr (hn::MaxLanes(Tag()) == 4) {
    return hn::LoadU(tag, reinterpret_cast<const float*>(first));
  } else {
    const hn::Half<Tag> half;
    constexpr std::size_t quads_of_half = hn::MaxLanes(half) / 4;
    return hn::Combine(tag, quads(half, first + quads_of_half * stride, stride), quads(half, first, stride));
  }
}
#endif

/// Place j of blocks 0 to 15, which follow one another from `spheres` on, times scale.
HWY_INLINE void load_place(const Sphere* spheres, std::uint32_t j, const Lanes16& scale, Vectors& at,
                           Lanes16& radius) {
  constexpr std::uint32_t block = BlockTree::block;
  using Tag = Lanes16::Tag;
  for (std::size_t k = 0; k < Lanes16::parts; ++k) {
    const Sphere* const s = spheres + k * Lanes16::width * block + j;
#if HWY_TARGET == HWY_SCALAR
    at.x.part[k] = hn::Set(Tag(), s->x), at.y.part[k] = hn::Set(Tag(), s->y);
    at.z.part[k] = hn::Set(Tag(), s->z), radius.part[k] = hn::Set(Tag(), s->radius);
#else
    // Quad q of `a` is block 4 q of this part, of `b` block 4 q + 1, and so on; then four by four transposed.
    const hn::Repartition<double, Tag> two;
    const auto a = quads(Tag(), s, 4 * block), b = quads(Tag(), s + block, 4 * block);
    const auto c = quads(Tag(), s + 2 * block, 4 * block), d = quads(Tag(), s + 3 * block, 4 * block);
    const auto xy_ab = hn::BitCast(two, hn::InterleaveLower(Tag(), a, b));
    const auto xy_cd = hn::BitCast(two, hn::InterleaveLower(Tag(), c, d));
    const auto zr_ab = hn::BitCast(two, hn::InterleaveUpper(Tag(), a, b));
    const auto zr_cd = hn::BitCast(two, hn::InterleaveUpper(Tag(), c, d));
    at.x.part[k] = hn::BitCast(Tag(), hn::InterleaveLower(two, xy_ab, xy_cd));
    at.y.part[k] = hn::BitCast(Tag(), hn::InterleaveUpper(two, xy_ab, xy_cd));
    at.z.part[k] = hn::BitCast(Tag(), hn::InterleaveLower(two, zr_ab, zr_cd));
    radius.part[k] = hn::BitCast(Tag(), hn::InterleaveUpper(two, zr_ab, zr_cd));
#endif
  }
  at = {at.x * scale, at.y * scale, at.z * scale};
  radius = radius * scale;
}

/// Capsules around the spheres, about the chord from first to last, moved half way to the middle of the arc.
/// Leaves the spheres relative to the centres. `reach` becomes a bound of |centre of sphere| + radius.
HWY_INLINE Capsules capsules_around(BlockSpheres& s, Lanes16& reach) {
  constexpr std::uint32_t last = BlockTree::block - 1;
  const Lanes16 half = Lanes16::all(0.5f), quarter = Lanes16::all(0.25f);
  const Vectors chord = s.at[last] - s.at[0];
  Capsules result;
  result.half = {chord.x * half, chord.y * half, chord.z * half};
  const Vectors middle = (s.at[last / 2] - s.at[0]) + (s.at[last / 2 + 1] - s.at[0]);
  result.centre = plus(plus(s.at[0], half, result.half), quarter, middle);
  const Lanes16 half_square = dot(result.half, result.half);
  result.inverse = inverse_square(half_square);
  Lanes16 farthest = Lanes16::all(0), thickest = s.radius[0];
  for (std::uint32_t j = 0; j <= last; ++j) {
    s.at[j] = s.at[j] - result.centre;
    farthest = max(farthest, distance_to_segment(s.at[j], result.half, result.inverse));
    thickest = max(thickest, s.radius[j]);
  }
  result.radius = with_slack(sqrt(farthest) + thickest, half_square);
  reach = sqrt(half_square) + result.radius;
  return result;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

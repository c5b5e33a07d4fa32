// From a chain to blocks, their capsules, and nodes of sixteen blocks.
#if defined(CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H
#endif

#include <limits>

#include "catena/core/blocks/ordered-inl.h"
#include "catena/core/blocks/tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Fills the capsules and order of group g, whose blocks are laid out.
HWY_INLINE void build_group(const ChainView& chain, BlockTree& tree, std::uint32_t g) {
  constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;
  const std::uint32_t begin = g * group;
  Sphere copy[(group + 1) * block];
  const Sphere* spheres = copy;
  // Seventeen blocks in one run: sixteen, and the next for the window of the last.
  const std::uint32_t next = begin + group;
  const bool in_one_run = next < tree.chain_blocks && !(tree.first[begin] & BlockTree::copied) &&
                          tree.first[next] == tree.first[begin] + group * block;
  if (in_one_run) {
    spheres = chain.spheres + tree.first[begin];
  } else {
    for (std::uint32_t k = 0; k <= group; ++k)
      std::memcpy(copy + k * block, tree.spheres(chain, begin + k < tree.blocks ? begin + k : tree.blocks - 1),
                  sizeof(Sphere) * block);
  }
  const Lanes16 scale = Lanes16::all(tree.scale);
  BlockSpheres own, following;
  for (std::uint32_t j = 0; j < block; ++j) load_place(spheres, j, scale, own.at[j], own.radius[j]);
  Lanes16 reach;
  const Capsules capsules = capsules_around(own, reach);
  capsules.store(tree.capsules_of(g));
  if (begin >= tree.chain_blocks) return;

  for (std::uint32_t j = 0; j < block; ++j)
    load_place(spheres + block, j, scale, following.at[j], following.radius[j]);
  std::uint32_t ordered = ordered_windows(own, capsules.centre, reach, following);
  if (!in_one_run || chain.strand_count > 1) {
    for (std::uint32_t k = 0; k < group; ++k) {
      const std::uint32_t b = begin + k;
      const bool joined = b + 1 < tree.chain_blocks && !(tree.first[b] & BlockTree::copied) &&
                          tree.first[b + 1] == tree.first[b] + block &&
                          (chain.strand_count == 1 || chain.exclusion.strand_of[tree.first[b]] ==
                                                          chain.exclusion.strand_of[tree.first[b + 1]]);
      if (!joined) ordered &= ~(1u << k);
    }
  }
  tree.ordered[g] = static_cast<std::uint16_t>(ordered);
}

/// A capsule around the first `used` of sixteen, about the way from the start of the first to the end of the last; with
/// the index `lane` among sixteen of `to`.
HWY_INLINE void enclose(const Capsules& c, const float* fields, std::uint32_t used, float* to, std::uint32_t lane) {
  const auto field = [&](std::uint32_t f, std::uint32_t k) { return fields[16 * f + k]; };
  const std::uint32_t last = used - 1, middle = used / 2;
  float centre[3], half[3], square = 0;
  for (std::uint32_t d = 0; d < 3; ++d) {
    const float start = field(d, 0) - field(3 + d, 0), end = field(d, last) + field(3 + d, last);
    half[d] = 0.5f * (end - start);
    const float chord_middle = start + half[d];
    centre[d] = chord_middle + 0.5f * (field(d, middle) - chord_middle);
    square += half[d] * half[d];
  }
  const Vectors h{Lanes16::all(half[0]), Lanes16::all(half[1]), Lanes16::all(half[2])};
  const Vectors offset = c.centre - Vectors{Lanes16::all(centre[0]), Lanes16::all(centre[1]), Lanes16::all(centre[2])};
  const Lanes16 inverse = inverse_square(Lanes16::all(square));
  const Lanes16 ends = max(distance_to_segment(offset + c.half, h, inverse), distance_to_segment(offset - c.half, h, inverse));
  // The rounding of offset +- half is relative to their lengths, which the slack of the reach covers.
  const Lanes16 radius = with_slack(sqrt(ends) + c.radius, Lanes16::all(square));
  for (std::uint32_t d = 0; d < 3; ++d) to[16 * d + lane] = centre[d], to[48 + 16 * d + lane] = half[d];
  to[96 + lane] = greatest(select(first_lanes<16>(used), radius, Lanes16::all(0)));
  to[112 + lane] = square > 0x1p-60f ? 1 / square : 0;
}

/// The box around the first `used` of sixteen.
HWY_INLINE void enclose(const Boxes& b, std::uint32_t used, float* to, std::uint32_t lane) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Flags<16> in_use = first_lanes<16>(used);
  const auto low = [&](const Lanes16& v) { return least(select(in_use, v, Lanes16::all(infinity))); };
  const auto high = [&](const Lanes16& v) { return greatest(select(in_use, v, Lanes16::all(-infinity))); };
  to[lane] = low(b.low.x), to[16 + lane] = low(b.low.y), to[32 + lane] = low(b.low.z);
  to[48 + lane] = high(b.high.x), to[64 + lane] = high(b.high.y), to[80 + lane] = high(b.high.z);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

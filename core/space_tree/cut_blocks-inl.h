// Blocks that the chain jumps in, which fit no capsule.
#if defined(CATENA_CORE_SPACE_TREE_CUT_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_CUT_BLOCKS_INL_H
#undef CATENA_CORE_SPACE_TREE_CUT_BLOCKS_INL_H
#else
#define CATENA_CORE_SPACE_TREE_CUT_BLOCKS_INL_H
#endif

#include "catena/core/blocks/build_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Steps of the chain within each of sixteen blocks, lane = block.
struct BlockSteps {
  static constexpr std::uint32_t steps = BlockTree::block - 1;
  Lanes16 length[steps];
  /// A longer one is a jump: four diameters, or twice that where the others are long too, but for those that
  /// are four times as long as the rest. Any number would do, as far as answers go.
  Lanes16 jump;

  explicit HWY_INLINE BlockSteps(const BlockSpheres& s) {
    Lanes16 sum = Lanes16::all(0), longest = Lanes16::all(0), thickest = s.radius[0];
    for (std::uint32_t j = 0; j < steps; ++j) {
      Vectors step = s.at[j + 1] - s.at[j];
      length[j] = sqrt(dot(step, step));
      sum = sum + length[j];
      longest = max(longest, length[j]);
      thickest = max(thickest, s.radius[j + 1]);
    }
    Lanes16 others = (sum - longest) * Lanes16::all(1.0f / (steps - 1)), four = Lanes16::all(4);
    jump = max(four * thickest, min(four * others, Lanes16::all(16) * thickest));
  }

  /// The blocks with a jump.
  HWY_INLINE std::uint32_t broken() const {
    Flags<16> any = jump < length[0];
    for (std::uint32_t j = 1; j < steps; ++j) any = any | (jump < length[j]);
    return any.bits();
  }
};

/// Those of the blocks of node g, of these spheres, that the chain jumps in. They are told part by part:
/// parts(block, first, size), spheres first to first + size - 1 of the block.
template <class Parts>
HWY_INLINE std::uint32_t cut(const BlockTree& tree, std::uint32_t g, const BlockSpheres& spheres,
                             const Parts& parts) {
  constexpr std::uint32_t group = BlockTree::group, steps = BlockSteps::steps;
  const BlockSteps of(spheres);
  const std::uint32_t broken = of.broken() & lane_bits(tree.blocks_of(g));
  if (broken == 0) return 0;
  float length[steps][group], jump[group];
  for (std::uint32_t j = 0; j < steps; ++j) of.length[j].store(length[j]);
  of.jump.store(jump);
  for_each_lane(broken, [&](std::uint32_t k) {
    const std::uint32_t b = g * group + k;
    std::uint32_t first = 0, size = 1;
    for (std::uint32_t j = 0; j < steps && tree.index(b, j + 1) != BlockTree::no_sphere; ++j, ++size)
      if (length[j][k] > jump[k]) parts(b, first, size), first = j + 1, size = 0;
    parts(b, first, size);
  });
  return broken;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

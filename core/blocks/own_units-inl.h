// Blocks of spheres so small that their squares lose digits, times a power of two.
#if defined(CATENA_CORE_BLOCKS_OWN_UNITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_OWN_UNITS_INL_H
#undef CATENA_CORE_BLOCKS_OWN_UNITS_INL_H
#else
#define CATENA_CORE_BLOCKS_OWN_UNITS_INL_H
#endif

#include <algorithm>
#include <cmath>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/scaled_spheres-inl.h"
#include "catena/core/chain/chain_view.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Of a chain of large and small spheres, the small ones' blocks: compared as they are, each pair of spheres
/// would be left to the exact stage. A power of two above 1 loses no bit of a number, and what overlaps in
/// one unit does so in another.
class OwnUnits {
 public:
  OwnUnits(const ChainView& chain, const BlockTree& tree) : tree_(tree) {
    const float unit = tree.scaled.empty() ? 1 : tree.scale;
    some_ = chain.extent.least_radius > 0 && chain.extent.least_radius * unit < small;
    constexpr int no_overflow = 126;
    const float farthest = std::max(chain.extent.greatest_coordinate * unit, small);
    most_ = std::max(no_overflow - std::ilogb(farthest), 0);
  }

  /// Not false where a block may be small.
  bool some() const { return some_; }

  /// Of two blocks, where both are small: copies of their spheres stand for these.
  void change(const Pair& blocks, const Sphere*& a, const Sphere*& b, Sphere* copies) const {
    const float by = inverse_of(std::max(radius(blocks.i), radius(blocks.j)));
    if (by == 1) return;
    scale_spheres(a, by, copies), scale_spheres(b, by, copies + block);
    a = copies, b = copies + block;
  }
  /// The same of a node's blocks and the next, from block `begin` and these spheres on.
  HWY_NOINLINE const Sphere* changed(std::uint32_t begin, const Sphere* spheres, Sphere* copies) const {
    constexpr std::uint32_t blocks = BlockTree::group + 1;
    float greatest = 0;
    for (std::uint32_t k = 0; k < blocks; ++k)
      greatest = std::max(greatest, radius(std::min(begin + k, tree_.blocks - 1)));
    const float by = inverse_of(greatest);
    if (by == 1) return spheres;
    for (std::uint32_t k = 0; k < blocks * block; k += block) scale_spheres(spheres + k, by, copies + k);
    return copies;
  }

 private:
  static constexpr std::uint32_t block = BlockTree::block;
  static constexpr float small = 0x1p-40f;

  /// Of a block's capsule, and so at least that of each of its spheres. Parts that the order of space cuts
  /// blocks into have none here, and are taken as they are.
  float radius(std::uint32_t b) const {
    return b < tree_.blocks ? tree_.capsule_radius(b) / tree_.unit() : small;
  }
  /// A power of two that brings it near to 1, if it is small; else 1.
  float inverse_of(float radius) const {
    return radius < small ? std::ldexp(1.0f, std::clamp(-std::ilogb(radius), 0, most_)) : 1;
  }

  const BlockTree& tree_;
  bool some_;
  int most_;  ///< exponent with which no coordinate overflows
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

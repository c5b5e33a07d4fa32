// Boxes along the axes of space, sixteen at once.
#if defined(CATENA_CORE_SPACE_TREE_AXIS_BOXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_AXIS_BOXES_INL_H
#undef CATENA_CORE_SPACE_TREE_AXIS_BOXES_INL_H
#else
#define CATENA_CORE_SPACE_TREE_AXIS_BOXES_INL_H
#endif

#include "catena/core/blocks/capsules-inl.h"
#include "catena/core/space_tree/space_tree.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

struct AxisBoxes {
  static constexpr std::uint32_t fields = SpaceTree::box_fields;
  Vectors low, high;

  static HWY_INLINE AxisBoxes load(const float* f) { return {Vectors::load(f), Vectors::load(f + 48)}; }
  static HWY_INLINE AxisBoxes all(const float* f, std::uint32_t lane) {
    return {Vectors::all(f, lane), Vectors::all(f + 48, lane)};
  }
  HWY_INLINE void store(float* f) const { low.store(f), high.store(f + 48); }
};

/// Around the spheres of sixteen blocks, relative to an origin; tighter than around capsules where the chain
/// bends. What is rounded, three times, is less than the slack times the way from the origin and the radius.
HWY_INLINE AxisBoxes boxes_around(const BlockSpheres& spheres, const Vectors& origin) {
  AxisBoxes boxes;
  const auto take_in = [&](std::uint32_t k, const Lanes16& at, Lanes16& low, Lanes16& high) HWY_ATTR {
    Lanes16 reach = mul_add(abs(at) + spheres.radius[k], Lanes16::all(BlockTree::slack), spheres.radius[k]) +
                    Lanes16::all(SpaceTree::tiny);
    low = k == 0 ? at - reach : min(low, at - reach);
    high = k == 0 ? at + reach : max(high, at + reach);
  };
  for (std::uint32_t k = 0; k < BlockTree::block; ++k) {
    Vectors at = spheres.at[k] - origin;
    take_in(k, at.x, boxes.low.x, boxes.high.x);
    take_in(k, at.y, boxes.low.y, boxes.high.y);
    take_in(k, at.z, boxes.low.z, boxes.high.z);
  }
  return boxes;
}

/// Those of sixteen boxes that have a point in common with their counterparts.
HWY_INLINE Flags<16> meet(const AxisBoxes& a, const AxisBoxes& b) {
  return ((a.low.x <= b.high.x) & (b.low.x <= a.high.x)) & ((a.low.y <= b.high.y) & (b.low.y <= a.high.y)) &
         ((a.low.z <= b.high.z) & (b.low.z <= a.high.z));
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Axes and centres of nodes, by how their children lie and are spread.
#if defined(CATENA_CORE_BLOCKS_NODE_AXES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_NODE_AXES_INL_H
#undef CATENA_CORE_BLOCKS_NODE_AXES_INL_H
#else
#define CATENA_CORE_BLOCKS_NODE_AXES_INL_H
#endif

#include "catena/core/blocks/oriented_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// What fills boxes evenly has this covariance about their centres; three times as much is added.
HWY_INLINE Symmetric plus_spread(Symmetric to, const OrientedBoxes& boxes) {
  for (int k = 0; k < 3; ++k) to = to.plus_square_of(scaled(boxes.axis[k], boxes.half[k]));
  return to;
}
HWY_INLINE Symmetric plus_spread(const Symmetric& to, const Capsules& capsules) {
  return to.plus_square_of(capsules.half);
}

/// Axes for sixteen nodes and a guess of their centres, from where their children lie and how these are
/// spread: else the axes of a path that goes back and forth would be those of where its parts happen to have
/// their middles. Of `group` children's ways from `origin` the sum and that of the squares, and three times
/// that of the spreads.
HWY_INLINE OrientedBoxes box_guess(const Vectors& origin, const Vectors& sum, Symmetric square,
                                   const Symmetric& spread) {
  square = square.plus(spread.scaled(Lanes16::all(1.0f / 3)));
  Vectors mean = scaled(sum, Lanes16::all(1.0f / BlockTree::group));
  OrientedBoxes result;
  Symmetric covariance{neg_mul_add(sum.x, mean.x, square.xx), neg_mul_add(sum.x, mean.y, square.xy),
                       neg_mul_add(sum.x, mean.z, square.xz), neg_mul_add(sum.y, mean.y, square.yy),
                       neg_mul_add(sum.y, mean.z, square.yz), neg_mul_add(sum.z, mean.z, square.zz)};
  principal_axes(covariance.without_less_than(1024 * least_product), result.axis);
  result.centre = origin + mean;
  return result;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Which nodes have children that follow one another along an axis, so that those not next to one another do
// not meet.
#if defined(CATENA_CORE_BLOCKS_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_ROWS_INL_H
#undef CATENA_CORE_BLOCKS_ROWS_INL_H
#else
#define CATENA_CORE_BLOCKS_ROWS_INL_H
#endif

#include "catena/core/blocks/oriented_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Sixteen rows, lane = node, told one child after another by how far it reaches along the node's axis.
/// Upwards a row holds while `low` never falls and each ends before the next but one begins: then so it does
/// before every later one. Downwards it is the same, mirrored. Intervals are rounded outward, so that what
/// holds of them holds of the children; NaN holds nowhere.
class Rows {
 public:
  HWY_INLINE explicit Rows(const Interval& first)
      : last_(first), before_(first), up_(first.low <= first.high), down_(up_) {}

  /// The next child of nodes, but for those that `exempt` names, which have none any more.
  HWY_INLINE void add(const Interval& child, const Flags<16>& exempt) {
    keep(exempt, child);
    if (++count_ > 1) {
      up_ = up_ & ((before_.high < child.low) | exempt);
      down_ = down_ & ((child.high < before_.low) | exempt);
    }
    before_ = last_, last_ = child;
  }
  /// One that is far enough from all but the first two before it, if the row goes on the same way.
  HWY_INLINE void add_further(const Interval& child) {
    keep(child.low < child.low, child);
    last_ = child;
  }
  HWY_INLINE std::uint32_t bits() const { return (up_ | down_).bits(); }

 private:
  HWY_INLINE void keep(const Flags<16>& exempt, const Interval& child) {
    up_ = up_ & ((last_.low <= child.low) | exempt);
    down_ = down_ & ((child.high <= last_.high) | exempt);
  }

  Interval last_, before_;
  Flags<16> up_, down_;
  std::uint32_t count_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

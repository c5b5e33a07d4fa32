// The buckets of many points at once. Compiled once a target: no include guard but Highway's.
#if defined(CATENA_CORE_GRID_BUCKETS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_BUCKETS_INL_H
#undef CATENA_CORE_GRID_BUCKETS_INL_H
#else
#define CATENA_CORE_GRID_BUCKETS_INL_H
#endif

#include <cstdint>

#include "catena/core/blocks/simd_targets.h"
#include "catena/core/grid/bucket_map.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A BucketMap for `lanes` points at a time.
class BucketFinder {
 public:
  using Wide = hn::CappedTag<double, 8>;
  using Narrow = hn::Rebind<float, Wide>;
  using Whole = hn::Rebind<std::int32_t, Wide>;
  static constexpr std::size_t lanes = hn::MaxLanes(Wide());

  explicit BucketFinder(const BucketMap& map) : map_(map) {}

  HWY_INLINE hn::Vec<Whole> operator()(hn::Vec<Narrow> x, hn::Vec<Narrow> y, hn::Vec<Narrow> z) const {
    const Wide wide;
    const auto buckets = hn::Set(wide, map_.buckets), zero = hn::Zero(wide);
    auto b =
        hn::MulAdd(cell(z), hn::Set(wide, map_.layer), hn::MulAdd(cell(y), hn::Set(wide, map_.row), cell(x)));
    b = hn::Sub(b, hn::Set(wide, map_.origin));
    if (map_.wraps) {
      // The quotient may be one off.
      b = hn::NegMulAdd(hn::Floor(hn::Mul(b, hn::Set(wide, 1.0 / map_.buckets))), buckets, b);
      b = hn::IfThenElse(hn::Lt(b, zero), hn::Add(b, buckets), b);
      b = hn::IfThenElse(hn::Ge(b, buckets), hn::Sub(b, buckets), b);
    }
    return hn::DemoteTo(Whole(), b);
  }

 private:
  HWY_INLINE hn::Vec<Wide> cell(hn::Vec<Narrow> v) const {
    const Wide wide;
    const auto at = hn::Mul(hn::PromoteTo(wide, v), hn::Set(wide, map_.cells_per_unit));
    const auto near = hn::Lt(hn::Abs(at), hn::Set(wide, BucketMap::far_cell));
    const auto floor = hn::Floor(at);
    if (HWY_LIKELY(hn::AllTrue(wide, near))) return floor;
    return hn::IfThenElse(near, floor, hash(v));
  }
  /// A whole number below far_cell, of the bits of a number.
  static HWY_INLINE hn::Vec<Wide> hash(hn::Vec<Narrow> v) {
    const hn::RebindToUnsigned<Narrow> bits;
    const auto mixed = hn::ShiftRight<7>(hn::Mul(hn::BitCast(bits, v), hn::Set(bits, 0x9E3779B1u)));
    return hn::PromoteTo(Wide(), hn::BitCast(Whole(), mixed));
  }

  const BucketMap& map_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

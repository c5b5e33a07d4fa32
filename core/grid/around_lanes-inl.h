// Which cells around their own several spheres reach.
#if defined(CATENA_CORE_GRID_AROUND_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_AROUND_LANES_INL_H
#undef CATENA_CORE_GRID_AROUND_LANES_INL_H
#else
#define CATENA_CORE_GRID_AROUND_LANES_INL_H
#endif

#include <cstdint>

#include "catena/core/grid/buckets-inl.h"
#include "catena/core/grid/sphere_grid.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// The buckets of spheres of a level, and into which cells before and behind its own along each axis a sphere
/// that overlaps one of them may have its centre. Of two that overlap no centre is farther than `reach` from
/// the other, and numbers and cells are in one order: see BucketMap.
class AroundLanes {
 public:
  static constexpr std::size_t lanes = BucketFinder::lanes;
  /// Bits, by their number.
  static constexpr int before_x = 0, behind_x = 1, before_y = 2, behind_y = 3, before_z = 4, behind_z = 5;

  explicit AroundLanes(const SphereGrid::Level& level) : level_(level), find_(level.map) {}

  HWY_INLINE void look(const float* x, const float* y, const float* z, const float* radius,
                       std::uint32_t* bucket, std::uint32_t* cells) const {
    const Narrow narrow;
    const Wide wide;
    const hn::RebindToUnsigned<BucketFinder::Whole> whole;
    const auto at_x = hn::LoadU(narrow, x), at_y = hn::LoadU(narrow, y), at_z = hn::LoadU(narrow, z);
    hn::StoreU(hn::BitCast(whole, find_(at_x, at_y, at_z)), whole, bucket);
    const auto sum = hn::Add(hn::PromoteTo(wide, hn::LoadU(narrow, radius)), hn::Set(wide, level_.greatest));
    const auto reach = hn::Mul(sum, hn::Set(wide, 1 + 0x1p-40));
    const auto all = hn::Add(hn::Add(along(at_x, reach, before_x), along(at_y, reach, before_y)),
                             along(at_z, reach, before_z));
    hn::StoreU(hn::BitCast(whole, hn::DemoteTo(BucketFinder::Whole(), all)), whole, cells);
  }

 private:
  using Wide = BucketFinder::Wide;
  using Narrow = BucketFinder::Narrow;

  /// The two bits of an axis, as a number.
  HWY_INLINE hn::Vec<Wide> along(hn::Vec<Narrow> v, hn::Vec<Wide> reach, int before) const {
    const Wide wide;
    const auto unit = hn::Set(wide, level_.map.cells_per_unit), at = hn::PromoteTo(wide, v);
    const auto own = hn::Mul(at, unit), cell = hn::Floor(own);
    const auto low = hn::Mul(hn::Sub(at, reach), unit), high = hn::Mul(hn::Add(at, reach), unit);
    const auto bit = [&](hn::Mask<Wide> reached, int number)
                         HWY_ATTR { return hn::IfThenElseZero(reached, hn::Set(wide, 1 << number)); };
    const auto bits = hn::Add(bit(hn::Lt(low, cell), before),
                              bit(hn::Le(hn::Add(cell, hn::Set(wide, 1)), high), before + 1));
    const auto near = hn::Lt(hn::Abs(own), hn::Set(wide, BucketMap::far_cell));
    if (HWY_LIKELY(hn::AllTrue(wide, near))) return bits;
    return hn::IfThenElse(near, bits, hn::Set(wide, 3 << before));
  }

  const SphereGrid::Level& level_;
  const BucketFinder find_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// The buckets of consecutive members of a level.
#if defined(CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H
#undef CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H
#else
#define CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H
#endif

#include "catena/core/grid/buckets-inl.h"
#include "catena/core/grid/sphere_grid.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

class MemberBuckets {
 public:
  static constexpr std::uint32_t most = 64;  ///< members at a time; a multiple of all lanes

  /// The buckets, by a map of any level, of members `first` to first + size - 1, at most `most`; valid until
  /// the next call.
  const std::uint32_t* find(const BucketFinder& find, const ChainView& chain, const SphereGrid& grid,
                            std::uint32_t first, std::uint32_t size) {
    const Sphere* spheres = chain.spheres + first;
    if (!grid.members.empty() || size < most) {
      for (std::uint32_t k = 0; k < size; ++k) copies_[k] = chain.spheres[grid.member(first + k)];
      spheres = copies_;
    }
    for (std::uint32_t k = 0; k < size; k += BucketFinder::lanes) {
      hn::Vec<BucketFinder::Narrow> x, y, z, r;
      hn::LoadInterleaved4(BucketFinder::Narrow(), reinterpret_cast<const float*>(spheres + k), x, y, z, r);
      const hn::RebindToUnsigned<BucketFinder::Whole> whole;
      hn::Store(hn::BitCast(whole, find(x, y, z)), whole, buckets_ + k);
    }
    return buckets_;
  }

 private:
  alignas(64) Sphere copies_[most] = {};
  alignas(64) std::uint32_t buckets_[most];
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

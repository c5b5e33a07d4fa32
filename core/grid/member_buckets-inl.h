// The buckets of consecutive members of a level.
#if defined(CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H
#undef CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H
#else
#define CATENA_CORE_GRID_MEMBER_BUCKETS_INL_H
#endif

#include <algorithm>
#include <atomic>

#include "catena/core/grid/buckets-inl.h"
#include "catena/core/grid/sphere_grid.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// One more in a cell, which others may count in too if it is not done `alone`; gives what was there.
HWY_INLINE std::uint32_t count_one(std::uint32_t& spheres, bool alone) {
  return alone ? spheres++ : std::atomic_ref(spheres).fetch_add(1, std::memory_order_relaxed);
}

/// What holds the centres of some spheres, and their greatest radius.
struct MemberBox {
  CentreBox centres;
  float radius;
};

class MemberBuckets {
 public:
  static constexpr std::uint32_t most = 64;  ///< members at a time; a multiple of all lanes

  /// Takes members `first` to first + size - 1, at most `most`, for what follows.
  void take(const ChainView& chain, const SphereGrid& grid, std::uint32_t first, std::uint32_t size) {
    spheres_ = chain.spheres + first;
    size_ = size;
    if (grid.members.empty() && size == most) return;
    for (std::uint32_t k = 0; k < size; ++k) copies_[k] = chain.spheres[grid.member(first + k)];
    spheres_ = copies_;
  }

  /// Their buckets by a map of any level; valid until the next call.
  const std::uint32_t* find(const BucketFinder& find) {
    for (std::uint32_t k = 0; k < size_; k += BucketFinder::lanes) {
      hn::Vec<BucketFinder::Narrow> x, y, z, r;
      hn::LoadInterleaved4(BucketFinder::Narrow(), reinterpret_cast<const float*>(spheres_ + k), x, y, z, r);
      const hn::RebindToUnsigned<BucketFinder::Whole> whole;
      hn::Store(hn::BitCast(whole, find(x, y, z)), whole, buckets_ + k);
    }
    return buckets_;
  }

  /// Around those from `begin` on that are before `end`, at least one.
  MemberBox box(std::uint32_t begin, std::uint32_t end) const {
    const Sphere& s = spheres_[begin];
    MemberBox result{{{s.x, s.y, s.z}, {s.x, s.y, s.z}}, s.radius};
    for (std::uint32_t k = begin + 1; k < end; ++k) {
      const float at[3] = {spheres_[k].x, spheres_[k].y, spheres_[k].z};
      for (std::size_t d = 0; d < 3; ++d) {
        result.centres.low[d] = std::min(result.centres.low[d], at[d]);
        result.centres.high[d] = std::max(result.centres.high[d], at[d]);
      }
      result.radius = std::max(result.radius, spheres_[k].radius);
    }
    return result;
  }

 private:
  const Sphere* spheres_ = nullptr;
  std::uint32_t size_ = 0;
  alignas(64) Sphere copies_[most] = {};
  alignas(64) std::uint32_t buckets_[most];
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

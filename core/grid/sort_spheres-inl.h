// Sorts the spheres of each level of a grid into its buckets.
#if defined(CATENA_CORE_GRID_SORT_SPHERES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_SORT_SPHERES_INL_H
#undef CATENA_CORE_GRID_SORT_SPHERES_INL_H
#else
#define CATENA_CORE_GRID_SORT_SPHERES_INL_H
#endif

#include <algorithm>

#include "catena/core/grid/member_buckets-inl.h"
#include "hwy/cache_control.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// A counting sort, which keeps the order of the chain within a bucket.
class SphereSort {
 public:
  SphereSort(const ChainView& chain, SphereGrid& grid) : chain_(chain), grid_(grid) {}

  void sort(const SphereGrid::Level& level) {
    count(level);
    add_up(level);
    place(level);
    copy(level);
  }

 private:
  static constexpr std::uint32_t ahead = 32;  // how far ahead memory is fetched

  void count(const SphereGrid::Level& level) {
    const BucketFinder find(level.map);
    std::uint32_t* const counts = grid_.start.data() + level.starts;
    MemberBuckets members;
    for (std::uint32_t at = level.first; at < level.end; at += MemberBuckets::most) {
      const std::uint32_t size = std::min(MemberBuckets::most, level.end - at);
      const std::uint32_t* const buckets = members.find(find, chain_, grid_, at, size);
      for (std::uint32_t k = 0; k < size; ++k) {
        grid_.bucket[at + k] = buckets[k];
        grid_.rank[at + k] = counts[buckets[k]]++;
      }
    }
  }

  /// Counts become places.
  void add_up(const SphereGrid::Level& level) {
    std::uint32_t* const start = grid_.start.data() + level.starts;
    std::uint32_t place = level.first;
    for (std::uint32_t b = 0; b <= level.map.buckets; ++b) {
      const std::uint32_t spheres = start[b];
      start[b] = place;
      place += spheres;
    }
  }

  void place(const SphereGrid::Level& level) {
    const std::uint32_t* const start = grid_.start.data() + level.starts;
    for (std::uint32_t at = level.first; at < level.end; ++at)
      grid_.index[start[grid_.bucket[at]] + grid_.rank[at]] = grid_.member(at);
  }

  void copy(const SphereGrid::Level& level) {
    const auto one = [&](std::uint32_t place) {
      const Sphere& s = chain_.spheres[grid_.index[place]];
      grid_.x[place] = s.x, grid_.y[place] = s.y, grid_.z[place] = s.z, grid_.radius[place] = s.radius;
    };
    std::uint32_t place = level.first;
    for (; place + ahead < level.end; ++place) {
      hwy::Prefetch(chain_.spheres + grid_.index[place + ahead]);
      one(place);
    }
    for (; place < level.end; ++place) one(place);
  }

  const ChainView& chain_;
  SphereGrid& grid_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Sorts the spheres of a grid of one level part by part of its buckets.
#if defined(CATENA_CORE_GRID_PARTED_SORT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_PARTED_SORT_INL_H
#undef CATENA_CORE_GRID_PARTED_SORT_INL_H
#else
#define CATENA_CORE_GRID_PARTED_SORT_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "catena/core/grid/member_buckets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// A counting sort in two steps, for one thread: where spheres that follow one another lie anywhere, and the
/// buckets are more than a core's own cache holds, each count and each place would be waited for. Spheres go
/// into parts of the buckets first, some hundred that are written one after the other each, and then into the
/// buckets of one part after the other. It leaves `start` and `index` as SphereSort does.
class PartedSort {
 public:
  PartedSort(const ChainView& chain, SphereGrid& grid, const SphereGrid::Level& level)
      : chain_(chain), grid_(grid), level_(level), start_(grid.start.data() + level.starts) {
    while (level.map.buckets >> shift_ >= most_parts) ++shift_;
  }

  /// That it takes less time than one counting sort.
  static bool pays(const ChainView& chain, const SphereGrid& grid, const SphereGrid::Level& level) {
    constexpr std::uint32_t in_cache = 1 << 17, samples = 32;
    if (grid.levels.size() > 1 || level.map.buckets <= in_cache) return false;
    // In buckets that cells share by chance nothing lies where the one before does.
    if (level.map.wraps) return true;
    std::uint32_t far = 0;
    for (std::uint32_t k = 0; k < samples; ++k) {
      const std::uint32_t at = std::uint64_t{level.end - 1} * k / samples;
      const Sphere &a = chain.spheres[grid.member(at)], &b = chain.spheres[grid.member(at + 1)];
      constexpr double cells = 8;
      far +=
          std::max({std::abs(double{a.x} - b.x), std::abs(double{a.y} - b.y), std::abs(double{a.z} - b.z)}) *
              level.map.cells_per_unit >
          cells;
    }
    return 2 * far > samples;
  }

  void run() {
    grid_.part_place.assign((level_.map.buckets >> shift_) + 2, 0);
    count();
    std::partial_sum(grid_.part_place.begin(), grid_.part_place.end(), grid_.part_place.begin());
    part();
    std::uint32_t first = level_.first;
    for (std::uint32_t p = 0; p << shift_ < level_.map.buckets; ++p) {
      const std::uint32_t end = level_.first + grid_.part_place[p];
      place(p << shift_, std::min(level_.map.buckets, (p + 1) << shift_), first, end);
      first = end;
    }
    start_[level_.map.buckets] = first;
  }

 private:
  static constexpr std::uint32_t most_parts = 512;

  /// Until spheres are copied there is room for what is known of them where coordinates will be.
  std::uint32_t number(const LargeVector<float>& in, std::uint32_t at) const {
    return std::bit_cast<std::uint32_t>(in[at]);
  }
  void set(LargeVector<float>& in, std::uint32_t at, std::uint32_t number) {
    in[at] = std::bit_cast<float>(number);
  }

  /// The bucket of each member, and how many come into each part.
  void count() {
    const BucketFinder find(level_.map);
    MemberBuckets members;
    for (std::uint32_t at = level_.first; at < level_.end; at += MemberBuckets::most) {
      const std::uint32_t size = std::min(MemberBuckets::most, level_.end - at);
      members.take(chain_, grid_, at, size);
      const std::uint32_t* const buckets = members.find(find);
      for (std::uint32_t k = 0; k < size; ++k) {
        set(grid_.x, at + k, buckets[k]);
        ++grid_.part_place[(buckets[k] >> shift_) + 1];
      }
    }
  }

  /// Afterwards each part's place is where it ends.
  void part() {
    for (std::uint32_t at = level_.first; at < level_.end; ++at) {
      const std::uint32_t bucket = number(grid_.x, at);
      const std::uint32_t to = level_.first + grid_.part_place[bucket >> shift_]++;
      set(grid_.y, to, bucket), set(grid_.z, to, grid_.member(at));
    }
  }

  /// The members of one part, first to end - 1, into their buckets; counts become places.
  void place(std::uint32_t begin_bucket, std::uint32_t end_bucket, std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t at = first; at < end; ++at) {
      const std::uint32_t bucket = number(grid_.y, at);
      set(grid_.x, at, start_[bucket]++);
    }
    std::uint32_t next = first;
    for (std::uint32_t b = begin_bucket; b < end_bucket; ++b) {
      const std::uint32_t spheres = start_[b];
      start_[b] = next;
      next += spheres;
    }
    for (std::uint32_t at = first; at < end; ++at)
      grid_.index[start_[number(grid_.y, at)] + number(grid_.x, at)] = number(grid_.z, at);
  }

  const ChainView& chain_;
  SphereGrid& grid_;
  const SphereGrid::Level& level_;
  std::uint32_t* const start_;
  std::uint32_t shift_ = 13;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

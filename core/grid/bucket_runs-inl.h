// What lies in several runs of buckets of a level.
#if defined(CATENA_CORE_GRID_BUCKET_RUNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_BUCKET_RUNS_INL_H
#undef CATENA_CORE_GRID_BUCKET_RUNS_INL_H
#else
#define CATENA_CORE_GRID_BUCKET_RUNS_INL_H
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "catena/core/grid/candidates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Runs of buckets, at most 18 in which there are spheres; one that passes the last bucket goes on at bucket
/// 0.
class BucketRuns {
 public:
  BucketRuns() = default;
  BucketRuns(const std::uint32_t* start, std::uint32_t buckets) : start_(start), buckets_(buckets) {}
  /// So many buckets from `bucket` on.
  HWY_INLINE void add(std::uint32_t bucket, std::uint32_t count) {
    if (HWY_UNLIKELY(bucket + count > buckets_)) {
      push(start_[0], start_[bucket + count - buckets_]);
      count = buckets_ - bucket;
    }
    push(start_[bucket], start_[bucket + count]);
  }
  /// Places first to end - 1.
  HWY_INLINE void push(std::uint32_t first, std::uint32_t end) {
    run_[size_] = {first, end};
    size_ += first != end;
    candidates_ += end - first;
  }
  std::uint32_t candidates() const { return candidates_; }
  const Run* begin() const { return run_.data(); }
  const Run* end() const { return run_.data() + size_; }

 private:
  const std::uint32_t* start_ = nullptr;
  std::uint32_t buckets_ = 0;
  std::array<Run, 18> run_;
  std::size_t size_ = 0;
  std::uint32_t candidates_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Spheres to be compared, gathered side by side, and the comparisons.
#if defined(CATENA_CORE_GRID_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_CANDIDATES_INL_H
#undef CATENA_CORE_GRID_CANDIDATES_INL_H
#else
#define CATENA_CORE_GRID_CANDIDATES_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/blocks/vector_hits-inl.h"
#include "catena/core/grid/grid_evidence.h"
#include "catena/core/grid/grid_queues.h"
#include "catena/core/grid/member_buckets-inl.h"
#include "catena/core/grid/sphere_grid.h"
#include "catena/core/prefetch.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Consecutive places of a grid.
struct Run {
  std::uint32_t first, end;
};

/// Found is as for VectorHits. Sink has the members of GridEvidence; NoGridEvidence costs nothing.
template <class Found, class Sink>
class Candidates {
 public:
  static constexpr std::uint32_t part = 1024;  ///< candidates at a time where a neighbourhood is too crowded

  Candidates(const SphereGrid& grid, GridQueues& queues, VectorHits<Found>& hits, Sink& sink)
      : from_{grid.x.data(), grid.y.data(), grid.z.data(), grid.radius.data(), grid.index.data()},
        equal_radii_(grid.equal_radii),
        q_(queues),
        sink_(sink),
        hits_(hits) {}

  /// False when so many candidates and spheres are too many for the queues.
  HWY_INLINE bool make_room(std::uint32_t candidates, std::uint32_t spheres) {
    const std::uint64_t tests = std::uint64_t{spheres} * (candidates / lanes + at_once);
    if (HWY_UNLIKELY(candidates + 2 * lanes > CandidateFields::room || tests > GridQueues::test_room))
      return false;
    if (size_ + candidates + 2 * lanes > CandidateFields::room || tests_ > GridQueues::test_limit)
      start_over();
    return true;
  }

  /// Tests what is queued and forgets the candidates.
  void start_over() {
    work_off();
    size_ = 0;
  }

  /// The first spheres of these runs will be asked for, or one alone.
  template <class Runs>
  HWY_INLINE void fetch_runs(const Runs& runs) const {
    for (const Run& run : runs) fetch(run.first);
  }
  HWY_INLINE void fetch(std::uint32_t place) const {
    prefetch(from_.x + place), prefetch(from_.y + place), prefetch(from_.z + place);
    prefetch(from_.radius + place), prefetch(from_.index + place);
  }

  /// The spheres of these runs become candidates, for which there is room. Returns the first; end() is behind
  /// the last.
  template <class Runs>
  HWY_INLINE std::uint32_t gather(const Runs& runs) {
    const Places from = from_;
    const bool equal = equal_radii_;
    CandidateFields& to = q_.candidates;
    std::uint32_t size = size_;
    for (const Run& run : runs) {
      const std::uint32_t count = run.end - run.first;
      std::uint32_t k = 0;
      do {  // mostly once, and never a branch for a run that is empty
        const std::uint32_t at = run.first + k;
        hn::StoreU(hn::LoadU(Tag(), from.x + at), Tag(), to.x + size + k);
        hn::StoreU(hn::LoadU(Tag(), from.y + at), Tag(), to.y + size + k);
        hn::StoreU(hn::LoadU(Tag(), from.z + at), Tag(), to.z + size + k);
        if (!equal) hn::StoreU(hn::LoadU(Tag(), from.radius + at), Tag(), to.radius + size + k);
        hn::StoreU(hn::LoadU(Bits(), from.index + at), Bits(), to.index + size + k);
        k += lanes;
      } while (HWY_UNLIKELY(k < count));
      size += count;
    }
    // What follows the last candidate in its vector overlaps nothing.
    hn::StoreU(hn::Set(Tag(), std::numeric_limits<float>::quiet_NaN()), Tag(), to.x + size);
    const std::uint32_t first = size_;
    end_ = size;
    size_ = size + lanes;
    return first;
  }
  std::uint32_t end() const { return end_; }

  /// True only when no sphere of the box may overlap a candidate from `from` on, as work_off decides it: with
  /// a centre outside the box no difference is smaller than that to the box, no radius is greater, and what
  /// stage 1 is certain of is so in exact arithmetic.
  HWY_INLINE bool apart(std::uint32_t from, const MemberBox& box) const {
    const CandidateFields& of = q_.candidates;
    const auto beside = [](const float* at, float low, float high) HWY_ATTR {
      const auto v = hn::LoadU(Tag(), at);
      return hn::Max(hn::Max(hn::Sub(hn::Set(Tag(), low), v), hn::Sub(v, hn::Set(Tag(), high))),
                     hn::Zero(Tag()));
    };
    for (std::uint32_t c = from; c < end_; c += lanes) {
      const auto dx = beside(of.x + c, box.centres.low[0], box.centres.high[0]);
      const auto dy = beside(of.y + c, box.centres.low[1], box.centres.high[1]);
      const auto dz = beside(of.z + c, box.centres.low[2], box.centres.high[2]);
      const auto radius = equal_radii_ ? hn::Set(Tag(), box.radius) : hn::LoadU(Tag(), of.radius + c);
      const auto reach = hn::Add(radius, hn::Set(Tag(), box.radius));
      if (!hn::AllFalse(Tag(), hits_.overlap_test()(dx, dy, dz, reach).may)) return false;
    }
    return true;
  }
  /// Forgets the candidates from `from` on, the last that were gathered, of which no test was queued.
  void forget(std::uint32_t from) { size_ = from; }

  /// Calls body(index) for those from `from` on.
  template <class Body>
  void for_each(std::uint32_t from, const Body& body) const {
    for (std::uint32_t c = from; c < end_; ++c) body(q_.candidates.index[c]);
  }

  /// The spheres of a run are to be compared with the candidates from `from` on, each `step` further than the
  /// one before.
  HWY_INLINE void test(const Run& spheres, std::uint32_t from, std::uint32_t step) {
    const std::uint32_t end = end_;
    GridQueues::Test* to = q_.tests.data() + tests_;
    const GridQueues::Test* const start = to;
    for (std::uint32_t p = spheres.first; p < spheres.end; ++p, from += step) {
      for (std::uint32_t k = 0; k < at_once; ++k) to[k] = {p, from + k * lanes};
      const std::uint32_t tests = (end - from + lanes - 1) / lanes;
      for (std::uint32_t k = at_once; HWY_UNLIKELY(k < tests); ++k) to[k] = {p, from + k * lanes};
      to += tests;
    }
    tests_ += static_cast<std::uint32_t>(to - start);
  }
  /// One sphere, where no room was made.
  void test_crowded(std::uint32_t place, std::uint32_t from) {
    if (tests_ > GridQueues::test_limit) work_off();
    if (from < end_) test({place, place + 1}, from, 0);
  }

 private:
  using Tag = SphereTag;
  using Bits = hn::RebindToUnsigned<Tag>;
  static constexpr std::uint32_t lanes = sphere_lanes;
  static constexpr std::uint32_t at_once = 4;  // tests that are written without asking

  struct Places {
    const float *x, *y, *z, *radius;
    const std::uint32_t* index;
  };

  void work_off() { equal_radii_ ? work_off_with<true>() : work_off_with<false>(); }

  template <bool equal_radii>
  HWY_NOINLINE void work_off_with() {
    const Places from =
        from_;  // a copy: what is stored below might be this object, for all the compiler knows
    const GridQueues::Test* const tests = q_.tests.data();
    const CandidateFields& of = q_.candidates;
    const std::uint32_t count = tests_;
    const float radius = equal_radii && count > 0 ? from.radius[0] : 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t p = tests[k].place, c = tests[k].candidate;
      if constexpr (Sink::listens) tell(from.index[p], c);
      hits_.template test<equal_radii>(
          from.index[p], {from.x[p], from.y[p], from.z[p], equal_radii ? radius : from.radius[p]},
          {of.x + c, CandidateFields::size, of.index + c});
    }
    q_.tests_done += count;
    tests_ = 0;
  }

  /// Sphere i is compared with the candidates of a vector; what follows the last is no number.
  void tell(std::uint32_t i, std::uint32_t c) const {
    for (std::uint32_t k = c; k < c + lanes; ++k)
      if (!std::isnan(q_.candidates.x[k])) sink_.compared(i, q_.candidates.index[k]);
  }

  const Places from_;
  const bool equal_radii_;
  GridQueues& q_;
  Sink& sink_;
  VectorHits<Found>& hits_;
  std::uint32_t size_ = 0, end_ = 0, tests_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

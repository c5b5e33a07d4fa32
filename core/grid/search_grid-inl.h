// The pairs of a SphereGrid: each bucket with half of those around it, and each finer level with the coarser
// ones.
#if defined(CATENA_CORE_GRID_SEARCH_GRID_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_SEARCH_GRID_INL_H
#undef CATENA_CORE_GRID_SEARCH_GRID_INL_H
#else
#define CATENA_CORE_GRID_SEARCH_GRID_INL_H
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "catena/core/grid/bucket_runs-inl.h"
#include "catena/core/grid/candidates-inl.h"
#include "catena/core/grid/lane_pairs-inl.h"
#include "catena/core/grid/member_buckets-inl.h"
#include "catena/core/prefetch.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Found and Sink as for Candidates; Found has satisfied(), true when nothing more is asked for.
template <class Found, class Sink>
class GridSearch {
 public:
  GridSearch(const ChainView& chain, const SphereGrid& grid, GridQueues& queues, Found& found, Sink& sink)
      : chain_(chain),
        grid_(grid),
        queues_(queues),
        found_(found),
        sink_(sink),
        hits_(chain, queues.hits, grid.doubt, queues.open_done, found),
        candidates_(grid, queues, hits_, sink),
        lanes_(grid, queues, hits_, sink) {}

  /// Pairs of level l whose bucket is begin to end - 1, begin even. A sphere is compared with those after it
  /// in its own group of buckets and the bucket behind, and with the four rows of cells that come after its
  /// own: the other half of its neighbourhood is compared with it.
  void within(std::size_t l, std::uint32_t begin, std::uint32_t end) {
    const Level& level = grid_.levels[l];
    const std::uint32_t* const start = grid_.start.data() + level.starts;
    if (level.wide) return within_wide(level, start[begin], start[end]);
    const std::uint32_t buckets = level.map.buckets;
    const std::array<std::uint32_t, 4> steps = level.half;
    for (std::uint32_t at = begin; at < end && !found_.satisfied(); at += group * groups_at_a_time) {
      for (const std::uint32_t b : groups(start, at, end)) {
        const std::uint32_t size = std::min(group, buckets - b);
        const Run own{start[b], start[b + size]};
        BucketRuns runs(start, buckets);
        // The own run comes first, and goes on to the next bucket; past the last bucket it is in two parts.
        if (HWY_LIKELY(b + size < buckets)) {
          runs.push(own.first, start[b + size + 1]);
        } else {
          runs.push(own.first, own.end);
          runs.push(start[0], start[1]);
        }
        for (const std::uint32_t step : steps) runs.add(before(b, step, buckets), size + 2);
        meet(own, runs);
      }
    }
    finish();
  }

  /// Members begin to end - 1 of level l against coarser levels, in all 27 cells around each. They come in
  /// the order of the chain: those that follow one another often lie in one of the wider cells, and share its
  /// candidates.
  void across(std::size_t l, std::uint32_t begin, std::uint32_t end) {
    MemberBuckets members;
    for (std::uint32_t at = begin; at < end && !found_.satisfied(); at += MemberBuckets::most) {
      const std::uint32_t size = std::min(MemberBuckets::most, end - at);
      members.take(chain_, grid_, at, size);
      const MemberBox all = members.box(0, size);
      for (std::size_t coarser = 0; coarser < l; ++coarser)
        if (within_reach(all, grid_.levels[coarser]))
          across(at, size, members, grid_.levels[coarser]);
        else
          tell_looks(at, at + size, grid_.levels[coarser], GridEvidence::into_none);
    }
    finish();
  }

 private:
  using Level = SphereGrid::Level;
  static constexpr std::uint32_t group = 2;  // buckets that share their candidates

  /// The same for spheres of wide cells, by their places.
  void within_wide(const Level& level, std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t at_a_time = 1024;
    const auto many = [&](std::uint32_t place, const Run& run) HWY_ATTR {
      if (HWY_LIKELY(candidates_.make_room(run.end - run.first, 1)))
        candidates_.test({place, place + 1}, candidates_.gather(std::array{run}), 0);
      else
        meet_crowd({place, place + 1}, std::array{run}, false);
    };
    for (std::uint32_t at = begin; at < end && !found_.satisfied(); at += at_a_time)
      lanes_.meet(level, at, std::min(end, at + at_a_time), many);
    finish();
  }

  void finish() {
    lanes_.finish();
    candidates_.start_over();
    hits_.finish();
  }

  /// Where three or more buckets begin that lie `step` and one bucket before them on from bucket b.
  static HWY_INLINE std::uint32_t before(std::uint32_t b, std::uint32_t step, std::uint32_t buckets) {
    const std::uint32_t to = b + step;
    return to >= buckets ? to - buckets : to;
  }

  /// The spheres of a run against the candidates behind each in the runs, the first of which begins with
  /// them.
  HWY_INLINE void meet(const Run& own, const BucketRuns& runs) {
    if (HWY_UNLIKELY(!candidates_.make_room(runs.candidates(), own.end - own.first)))
      return meet_crowd(own, runs, true);
    candidates_.test(own, candidates_.gather(runs) + 1, 1);
  }

  /// The same, or all candidates, part by part: where they are too many for the queues.
  template <class Some>
  HWY_NOINLINE void meet_crowd(const Run& own, const Some& runs, bool behind) {
    for (const Run& run : runs) {
      for (Run part{run.first, 0}; part.first < run.end && !found_.satisfied(); part.first = part.end) {
        part.end = std::min(run.end, part.first + Candidates<Found, Sink>::part);
        candidates_.start_over();
        const std::uint32_t first = candidates_.gather(std::array{part});
        for (std::uint32_t p = own.first; p < own.end; ++p)
          candidates_.test_crowded(p, first + (behind && p >= part.first ? p + 1 - part.first : 0));
      }
      behind = false;
    }
  }

  /// False only when no sphere of a box overlaps one of a level. In binary64 a difference or sum of two
  /// binary32 numbers is wrong by 2^-53 of itself at most.
  static bool within_reach(const MemberBox& box, const Level& level) {
    const double reach = reach_of(box, level);
    for (std::size_t d = 0; d < 3; ++d) {
      if (double{box.centres.low[d]} - level.centres.high[d] > reach) return false;
      if (double{level.centres.low[d]} - box.centres.high[d] > reach) return false;
    }
    return true;
  }

  /// Members at to at + size - 1 of a level against a coarser level.
  void across(std::uint32_t at, std::uint32_t size, MemberBuckets& members, const Level& coarse) {
    const std::uint32_t* const start = grid_.start.data() + coarse.starts;
    const std::uint32_t* const bucket = members.find(BucketFinder(coarse.map));
    for (std::uint32_t k = 0; k < size; ++k) {
      if (k > 0 && bucket[k] == bucket[k - 1]) continue;
      for (const std::uint32_t row : coarse.rows)
        prefetch(start + before(bucket[k], row, coarse.map.buckets));
    }
    // Some at a time: while their first candidates are met, those of the others are on their way from memory.
    std::array<Together, 8> some;
    for (std::uint32_t k = 0, next; k < size;) {
      std::size_t count = 0;
      for (; k < size && count < some.size(); k = next) {
        next = k + 1;
        while (next < size && bucket[next] == bucket[k]) ++next;
        Together& these = some[count];
        these = {at + k, at + next, members.box(k, next), BucketRuns(start, coarse.map.buckets)};
        const Around around(these.box, coarse);
        add_near(around, coarse, bucket[k], these.runs);
        tell_looks(these.first, these.end, coarse, around.bits());
        if (these.runs.candidates() == 0) continue;
        candidates_.fetch_runs(these.runs);
        for (std::uint32_t m = these.first; m < these.end; ++m) candidates_.fetch(grid_.place[m]);
        ++count;
      }
      for (std::size_t s = 0; s < count; ++s) meet_members(some[s]);
    }
  }

  /// Members of a level that follow one another in one cell of a coarser one, and what is near them there.
  struct Together {
    std::uint32_t first, end;
    MemberBox box;
    BucketRuns runs;
  };

  /// Whether what is near a box may be in the cells before and behind its own, along axis d. A centre is no
  /// farther than `reach`, so its number is none below that of low - reach, rounded, as numbers and cells are
  /// in one order: see BucketMap. A box of several cells, which share a bucket by chance, or of far ones has
  /// both.
  struct CellsAround {
    bool before = true, behind = true;
    HWY_INLINE CellsAround(const MemberBox& box, const Level& level, std::size_t d) {
      const double unit = level.map.cells_per_unit, low = box.centres.low[d], high = box.centres.high[d];
      const double own = std::floor(low * unit), reach = reach_of(box, level);
      if (own != std::floor(high * unit) || !(std::abs(low * unit) < BucketMap::far_cell)) return;
      before = std::floor((low - reach) * unit) < own;
      behind = std::floor((high + reach) * unit) > own;
    }
  };

  struct Around {
    CellsAround x, y, z;
    HWY_INLINE Around(const MemberBox& box, const Level& level)
        : x(box, level, 0), y(box, level, 1), z(box, level, 2) {}
    std::uint8_t bits() const {
      return static_cast<std::uint8_t>(x.before | x.behind << 1 | y.before << 2 | y.behind << 3 |
                                       z.before << 4 | z.behind << 5);
    }
  };
  /// Of the 27 cells around members of a bucket those that a coarser sphere which overlaps one may be in.
  static HWY_INLINE void add_near(const Around& around, const Level& coarse, std::uint32_t bucket,
                                  BucketRuns& runs) {
    const auto& [x, y, z] = around;
    const std::uint32_t skipped = !x.before, count = 1 + x.before + x.behind;
    for (int dz = -static_cast<int>(z.before); dz <= static_cast<int>(z.behind); ++dz)
      for (int dy = -static_cast<int>(y.before); dy <= static_cast<int>(y.behind); ++dy)
        runs.add(before(before(bucket, coarse.rows[3 * (dz + 1) + dy + 1], coarse.map.buckets), skipped,
                        coarse.map.buckets),
                 count);
  }
  void tell_looks([[maybe_unused]] std::uint32_t first, [[maybe_unused]] std::uint32_t end,
                  [[maybe_unused]] const Level& coarse, [[maybe_unused]] std::uint8_t cells) const {
    if constexpr (Sink::listens)
      for (std::uint32_t m = first; m < end; ++m)
        sink_.looks(grid_.member(m), static_cast<std::size_t>(&coarse - grid_.levels.data()), cells);
  }

  /// At least the distance of centres at which a sphere of a box may overlap one of a level.
  static HWY_INLINE double reach_of(const MemberBox& box, const Level& level) {
    return (double{box.radius} + level.greatest) * (1 + 0x1p-40);
  }

  /// Members against all that is near them; none, when these lie apart from the members' box.
  void meet_members(const Together& these) {
    constexpr std::uint32_t worth_a_box = 4;
    const std::uint32_t members = these.end - these.first;
    const std::span places(grid_.place.data() + these.first, members);
    if (HWY_LIKELY(candidates_.make_room(these.runs.candidates(), members))) {
      const std::uint32_t from = candidates_.gather(these.runs);
      if (members >= worth_a_box && candidates_.apart(from, these.box)) {
        tell_apart(these, from);
        return candidates_.forget(from);
      }
      for (const std::uint32_t place : places) candidates_.test({place, place + 1}, from, 0);
    } else {
      for (const std::uint32_t place : places) meet_crowd({place, place + 1}, these.runs, false);
    }
  }

  void tell_apart([[maybe_unused]] const Together& these, [[maybe_unused]] std::uint32_t from) const {
    if constexpr (Sink::listens)
      for (std::uint32_t m = these.first; m < these.end; ++m)
        candidates_.for_each(from, [&](std::uint32_t j) { sink_.apart(grid_.member(m), j); });
  }

  static constexpr std::uint32_t groups_at_a_time = GridQueues::group_room;

  /// The first buckets of those of the next groups before `last` that have spheres; without a branch, which
  /// would be foretold badly.
  std::span<const std::uint32_t> groups(const std::uint32_t* start, std::uint32_t at, std::uint32_t last) {
    std::uint32_t* const list = queues_.groups.data();
    std::size_t size = 0;
    const std::uint32_t end = std::min(last, at + group * groups_at_a_time);
    for (std::uint32_t b = at; b < end; b += group) {
      list[size] = b;
      size += start[b] != start[std::min(b + group, last)];
    }
    return {list, size};
  }

  const ChainView& chain_;
  const SphereGrid& grid_;
  GridQueues& queues_;
  Found& found_;
  Sink& sink_;
  VectorHits<Found> hits_;
  Candidates<Found, Sink> candidates_;
  LanePairs<Found, Sink> lanes_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Where little is near: pairs of a sphere and a candidate, each in a lane of its own.
#if defined(CATENA_CORE_GRID_LANE_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_LANE_PAIRS_INL_H
#undef CATENA_CORE_GRID_LANE_PAIRS_INL_H
#else
#define CATENA_CORE_GRID_LANE_PAIRS_INL_H
#endif

#include <algorithm>

#include "catena/core/blocks/compress-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/lanes-inl.h"
#include "catena/core/grid/around_lanes-inl.h"
#include "catena/core/grid/candidates-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// The pairs of a level whose cells are wide: along each axis a sphere reaches into one of the two beside its
/// own, mostly. Several spheres at once look where candidates for them begin and end, and each pair becomes a
/// lane of its own: few candidates a sphere would leave vectors of them nearly empty. Found and Sink as for
/// Candidates.
template <class Found, class Sink>
class LanePairs {
 public:
  using Level = SphereGrid::Level;

  LanePairs(const SphereGrid& grid, GridQueues& queues, VectorHits<Found>& hits, Sink& sink)
      : grid_(grid), q_(queues), hits_(hits), sink_(sink) {}

  /// The spheres of places begin to end - 1 of a level, each with those behind it in its own bucket, the next
  /// one, and the four rows of three that come after, as far as it reaches. many(place, run) is called where
  /// candidates are better met in vectors.
  template <class Many>
  void meet(const Level& level, std::uint32_t begin, std::uint32_t end, const Many& many) {
    const AroundLanes around(level);
    for (std::uint32_t at = begin; at < end; at += GridQueues::Rows::spheres) {
      const std::uint32_t next = std::min(end, at + GridQueues::Rows::spheres);
      q_.reached.size = q_.rows.size = 0;
      for (std::uint32_t p = at; p < next; p += lanes) reach_rows(level, around, p, next, many);
      list_rows(level, many);
      pair_up();
    }
  }

  /// Compares what is left.
  void finish() {
    work_off();
    if (pairs_ == 0) return;
    // Behind the last the first sphere with itself, which is not counted.
    const Bits bits;
    hn::StoreU(hn::Zero(bits), bits, q_.pairs.a.data() + pairs_);
    hn::StoreU(hn::Zero(bits), bits, q_.pairs.b.data() + pairs_);
    compare(pairs_);
    pairs_ = 0;
  }

 private:
  using Tag = SphereTag;
  using Bits = hn::RebindToUnsigned<Tag>;
  using Places = hn::RebindToSigned<Tag>;
  using Lanes = hn::Vec<Bits>;
  static constexpr std::uint32_t lanes = sphere_lanes;
  static constexpr std::uint32_t few = 8;  ///< candidates of a row; more are met in vectors

  /// Rows of cells around spheres p and following, before `end`, that they reach.
  template <class Many>
  HWY_INLINE void reach_rows(const Level& level, const AroundLanes& around, std::uint32_t p,
                             std::uint32_t end, const Many& many) {
    const Bits bits;
    alignas(64) std::uint32_t bucket[lanes], cells[lanes];
    for (std::uint32_t k = 0; k < lanes; k += AroundLanes::lanes)
      around.look(grid_.x.data() + p + k, grid_.y.data() + p + k, grid_.z.data() + p + k,
                  grid_.radius.data() + p + k, bucket + k, cells + k);
    const auto there = hn::FirstN(bits, end - p);
    const auto own = hn::IfThenElseZero(there, hn::Load(bits, bucket)), reached = hn::Load(bits, cells);
    const auto one = hn::Set(bits, 1), buckets = hn::Set(bits, level.map.buckets), place = count_up(bits, p);
    const auto before = hn::And(reached, one), behind = hn::And(hn::ShiftRight<1>(reached), one);
    const auto within = [&](hn::Mask<Bits> some, Lanes first, Lanes last, bool of_own) HWY_ATTR {
      const auto past = hn::And(some, hn::Gt(last, buckets));
      if (HWY_LIKELY(hn::AllFalse(bits, past))) return some;
      list_past_the_last(level, past, p, first, last, of_own, many);
      return hn::AndNot(past, some);
    };
    const auto own_last = hn::Add(hn::Add(own, one), behind);
    const auto own_row = within(there, own, own_last, true);
    list(place, hn::Add(place, one), starts(level, hn::IfThenElseZero(own_row, own_last)), own_row, many);
    const auto reaches = [&](int cell) HWY_ATTR {
      return hn::And(there, hn::TestBit(reached, hn::Set(bits, 1u << cell)));
    };
    const auto before_y = reaches(AroundLanes::before_y), behind_y = reaches(AroundLanes::behind_y),
               behind_z = reaches(AroundLanes::behind_z);
    const hn::Mask<Bits> rows[] = {behind_y, hn::And(behind_z, before_y), behind_z,
                                   hn::And(behind_z, behind_y)};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto on = hn::Add(own, hn::Set(bits, level.half[k]));
      const auto middle = hn::Add(hn::Min(on, hn::Sub(on, buckets)), one);  // the lesser is in range
      const auto first = hn::Sub(middle, before), last = hn::Add(hn::Add(middle, one), behind);
      append(q_.reached, place, first, last, within(rows[k], first, last, false));
    }
    if constexpr (Sink::listens)
      for (std::uint32_t k = 0; k < std::min(lanes, end - p); ++k)
        tell_unreached(level, p + k, bucket[k], cells[k]);
  }

  /// Of the rows that are reached those that have candidates.
  template <class Many>
  HWY_INLINE void list_rows(const Level& level, const Many& many) {
    const Bits bits;
    const GridQueues::Rows& rows = q_.reached;
    for (std::uint32_t k = 0; k < rows.size; k += lanes) {
      const auto some = hn::FirstN(bits, rows.size - k);
      const auto bucket = [&](const std::uint32_t* of)
                              HWY_ATTR { return hn::IfThenElseZero(some, hn::LoadU(bits, of + k)); };
      list(hn::LoadU(bits, rows.place.data() + k), starts(level, bucket(rows.from.data())),
           starts(level, bucket(rows.until.data())), some, many);
    }
  }

  /// Where buckets start.
  HWY_INLINE Lanes starts(const Level& level, Lanes bucket) const {
    return hn::GatherIndex(Bits(), grid_.start.data() + level.starts, hn::BitCast(Places(), bucket));
  }

  static HWY_INLINE void append(GridQueues::Rows& to, Lanes place, Lanes from, Lanes until,
                                hn::Mask<Bits> some) {
    const Bits bits;
    const Kept<Bits> kept(some);
    hn::StoreU(kept.compress(place), bits, to.place.data() + to.size);
    hn::StoreU(kept.compress(from), bits, to.from.data() + to.size);
    hn::StoreU(kept.compress(until), bits, to.until.data() + to.size);
    to.size += kept.size();
  }

  /// Those of these lanes that have candidates.
  template <class Many>
  HWY_INLINE void list(Lanes place, Lanes from, Lanes until, hn::Mask<Bits> some, const Many& many) {
    const Bits bits;
    auto has = hn::And(some, hn::Lt(from, until));
    const auto crowded = hn::And(has, hn::Gt(hn::Sub(until, from), hn::Set(bits, few)));
    if (HWY_UNLIKELY(!hn::AllFalse(bits, crowded))) {
      meet_crowded(place, from, until, crowded, many);
      has = hn::AndNot(crowded, has);
    }
    append(q_.rows, place, from, until, has);
  }

  template <class Many>
  HWY_NOINLINE void meet_crowded(Lanes place, Lanes from, Lanes until, hn::Mask<Bits> crowded,
                                 const Many& many) {
    const Bits bits;
    alignas(64) std::uint32_t places[lanes], firsts[lanes], ends[lanes];
    hn::Store(place, bits, places), hn::Store(from, bits, firsts), hn::Store(until, bits, ends);
    for_each_lane(bits_of(crowded), [&](std::uint32_t k) { many(places[k], Run{firsts[k], ends[k]}); });
  }

  /// Rows that go on at bucket 0, of spheres p and following.
  template <class Many>
  HWY_NOINLINE void list_past_the_last(const Level& level, hn::Mask<Bits> past, std::uint32_t p, Lanes first,
                                       Lanes last, bool of_own, const Many& many) {
    const Bits bits;
    const std::uint32_t* const start = grid_.start.data() + level.starts;
    const std::uint32_t buckets = level.map.buckets;
    alignas(64) std::uint32_t firsts[lanes], lasts[lanes];
    hn::Store(first, bits, firsts), hn::Store(last, bits, lasts);
    for_each_lane(bits_of(past), [&](std::uint32_t k) {
      for (std::uint32_t b = firsts[k]; b < lasts[k]; ++b) {
        const std::uint32_t at = b < buckets ? b : b - buckets;
        const Run run{of_own && b == firsts[k] ? p + k + 1 : start[at], start[at + 1]};
        if (run.first >= run.end) continue;
        if (run.end - run.first > few) {
          many(p + k, run);
        } else {
          GridQueues::Rows& to = q_.rows;
          to.place[to.size] = p + k, to.from[to.size] = run.first, to.until[to.size] = run.end;
          ++to.size;
        }
      }
    });
  }

  static HWY_INLINE std::uint32_t bits_of(hn::Mask<Bits> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Bits(), mask, bytes);
    return bytes[0] | std::uint32_t{bytes[1]} << 8;
  }

  /// Each sphere with each candidate of its rows.
  HWY_INLINE void pair_up() {
    const Bits bits;
    const GridQueues::Rows& rows = q_.rows;
    const auto one = hn::Set(bits, 1);
    for (std::uint32_t k = 0; k < rows.size; k += lanes) {
      const auto place = hn::LoadU(bits, rows.place.data() + k),
                 until = hn::LoadU(bits, rows.until.data() + k);
      auto candidate = hn::LoadU(bits, rows.from.data() + k);
      auto some = hn::FirstN(bits, rows.size - k);
      do {
        const Kept<Bits> kept(some);
        hn::StoreU(kept.compress(place), bits, q_.pairs.a.data() + pairs_);
        hn::StoreU(kept.compress(candidate), bits, q_.pairs.b.data() + pairs_);
        pairs_ += kept.size();
        candidate = hn::Add(candidate, one);
        some = hn::And(some, hn::Lt(candidate, until));
        if (HWY_UNLIKELY(pairs_ >= GridQueues::Pairs::limit)) work_off();
      } while (!hn::AllFalse(bits, some));
    }
  }

  /// All but those that fill no vector.
  HWY_NOINLINE void work_off() {
    const std::uint32_t whole = pairs_ / lanes * lanes;
    compare(whole);
    std::copy_n(q_.pairs.a.begin() + whole, pairs_ - whole, q_.pairs.a.begin());
    std::copy_n(q_.pairs.b.begin() + whole, pairs_ - whole, q_.pairs.b.begin());
    pairs_ -= whole;
  }
  void compare(std::uint32_t pairs) {
    grid_.equal_radii ? compare_with<true>(pairs) : compare_with<false>(pairs);
  }

  template <bool equal_radii>
  HWY_INLINE void compare_with(std::uint32_t pairs) {
    const Bits bits;
    const auto field = [&](const float* of, Lanes at)
                           HWY_ATTR { return hn::GatherIndex(Tag(), of, hn::BitCast(Places(), at)); };
    const auto apart = [&](const LargeVector<float>& of, Lanes a, Lanes b)
                           HWY_ATTR { return hn::Sub(field(of.data(), b), field(of.data(), a)); };
    const auto index = [&](Lanes at) HWY_ATTR {
      return hn::GatherIndex(bits, grid_.index.data(), hn::BitCast(Places(), at));
    };
    const float* const radius = grid_.radius.data();
    const auto twice = hn::Set(Tag(), equal_radii && pairs > 0 ? radius[0] + radius[0] : 0);
    const OverlapTest& overlap = hits_.overlap_test();
    for (std::uint32_t k = 0; k < pairs; k += lanes) {
      const auto a = hn::LoadU(bits, q_.pairs.a.data() + k), b = hn::LoadU(bits, q_.pairs.b.data() + k);
      if constexpr (Sink::listens)
        for (std::uint32_t n = k; n < std::min(pairs, k + lanes); ++n)
          sink_.compared(grid_.index[q_.pairs.a[n]], grid_.index[q_.pairs.b[n]]);
      const OverlapTest::Verdict verdict =
          overlap(apart(grid_.x, a, b), apart(grid_.y, a, b), apart(grid_.z, a, b),
                  equal_radii ? twice : hn::Add(field(radius, a), field(radius, b)));
      const auto may = hn::And(verdict.may, hn::FirstN(Tag(), pairs - k));
      if (!hn::AllFalse(Tag(), may)) hits_.add(index(a), index(b), {may, verdict.certain});
    }
    q_.tests_done += (pairs + lanes - 1) / lanes;
  }

  /// The spheres of cells next to that of one, behind it, which it does not reach.
  void tell_unreached(const Level& level, std::uint32_t place, std::uint32_t bucket,
                      std::uint32_t cells) const {
    const std::uint32_t* const start = grid_.start.data() + level.starts;
    const std::uint32_t buckets = level.map.buckets;
    const auto reached = [&](int before, int on) {
      return on == 0 || (cells >> (before + (on > 0)) & 1) != 0;
    };
    constexpr int rows[5][2] = {{0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};
    for (std::size_t row = 0; row < 5; ++row) {
      const bool row_reached =
          reached(AroundLanes::before_y, rows[row][0]) && reached(AroundLanes::before_z, rows[row][1]);
      for (int x = row == 0 ? 1 : -1; x <= 1; ++x) {
        if (row_reached && reached(AroundLanes::before_x, x)) continue;
        const std::uint32_t step = row == 0 ? 0 : level.half[row - 1] + 1,
                            at = (bucket + step + static_cast<std::uint32_t>(x + static_cast<int>(buckets))) %
                                 buckets;
        for (std::uint32_t p = start[at]; p < start[at + 1]; ++p)
          sink_.apart(grid_.index[place], grid_.index[p]);
      }
    }
  }

  const SphereGrid& grid_;
  GridQueues& q_;
  VectorHits<Found>& hits_;
  Sink& sink_;
  std::uint32_t pairs_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// Spheres to be compared, gathered side by side, and the comparisons.
#if defined(CATENA_CORE_GRID_CANDIDATES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_CANDIDATES_INL_H
#undef CATENA_CORE_GRID_CANDIDATES_INL_H
#else
#define CATENA_CORE_GRID_CANDIDATES_INL_H
#endif

#include <algorithm>
#include <bit>
#include <limits>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/grid/grid_queues.h"
#include "catena/core/grid/sphere_grid.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

class Candidates {
 public:
  static constexpr std::uint32_t part = 1024;  ///< candidates at a time where a neighbourhood is too crowded

  Candidates(const ChainView& chain, const SphereGrid& grid, GridQueues& queues, PairCollector::Lane& lane)
      : chain_(chain), grid_(grid), q_(queues), lane_(lane) {
    const ExclusionView& rule = chain.exclusion;
    const bool window = rule.rule == Exclusion::Rule::index_window && rule.one_open_strand;
    window_ = window ? std::min(rule.window, chain.size) : 0;
    window_is_all_ = window && rule.extra_row == nullptr;
  }

  std::uint32_t size() const { return size_; }

  /// False when so many candidates and spheres are too many for the queues.
  HWY_INLINE bool make_room(std::uint32_t candidates, std::uint32_t spheres) {
    const std::uint64_t tests = std::uint64_t{spheres} * (candidates / lanes + 1);
    if (HWY_UNLIKELY(candidates + 2 * lanes > GridQueues::room || tests > GridQueues::test_room)) return false;
    if (size_ + candidates + 2 * lanes > GridQueues::room || tests_ > GridQueues::test_limit) start_over();
    return true;
  }

  /// Tests what is queued and forgets the candidates.
  void start_over() {
    work_off();
    size_ = 0;
  }

  void finish() {
    start_over();
    flush();
  }

  /// The spheres at these places become candidates.
  HWY_INLINE void add(std::uint32_t first, std::uint32_t end) {
    const std::uint32_t to = size_;
    for (std::uint32_t k = 0; first + k < end; k += lanes) {
      const auto move = [&](const auto& from, auto& field) {
        hn::StoreU(hn::LoadU(hn::CappedTag<typename std::decay_t<decltype(from)>::value_type, lanes>(),
                             from.data() + first + k),
                   hn::CappedTag<typename std::decay_t<decltype(from)>::value_type, lanes>(),
                   field.data() + to + k);
      };
      move(grid_.x, q_.x), move(grid_.y, q_.y), move(grid_.z, q_.z), move(grid_.radius, q_.radius);
      move(grid_.index, q_.index);
    }
    size_ += end - first;
  }

  /// No candidate more for the next tests: what follows the last one in its vector overlaps nothing.
  HWY_INLINE void fill_up() {
    hn::StoreU(hn::Set(Tag(), std::numeric_limits<float>::quiet_NaN()), Tag(), q_.x.data() + size_);
    end_ = size_;
    size_ += lanes;
  }

  /// The sphere at a place is to be compared with the candidates from `from` on.
  HWY_INLINE void test(std::uint32_t place, std::uint32_t from) {
    for (; from < end_; from += lanes) q_.tests[tests_++] = {place, from};
  }
  HWY_INLINE void test_crowded(std::uint32_t place, std::uint32_t from) {
    if (tests_ > GridQueues::test_limit) work_off();
    test(place, from);
  }

 private:
  using Tag = hn::CappedTag<float, GridQueues::most_lanes>;
  using Bits = hn::RebindToUnsigned<Tag>;
  static constexpr std::uint32_t lanes = hn::MaxLanes(Tag());

  void work_off() {
    for (std::uint32_t k = 0; k < tests_; ++k) {
      compare(q_.tests[k]);
      if (hits_ >= GridQueues::hit_limit) flush();
    }
    tests_ = 0;
  }

  /// Stage 1 of Robust, as sphere_pairs has it: q = |cA - cB|^2 against t = (rA + rB)^2. No number is a NaN but where
  /// there is no candidate.
  HWY_INLINE void compare(const GridQueues::Test& test) {
    const std::uint32_t p = test.place, c = test.candidate;
    const auto slack = hn::Set(Tag(), 1 + 12 * 0x1p-24f), floor = hn::Set(Tag(), 0x1p-120f);
    const auto difference = [&](const std::vector<float>& fields, const std::vector<float>& of) {
      return hn::Sub(hn::LoadU(Tag(), of.data() + c), hn::Set(Tag(), fields[p]));
    };
    const auto dx = difference(grid_.x, q_.x), dy = difference(grid_.y, q_.y), dz = difference(grid_.z, q_.z);
    const auto reach = hn::Add(hn::LoadU(Tag(), q_.radius.data() + c), hn::Set(Tag(), grid_.radius[p]));
    const auto q = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), t = hn::Mul(reach, reach);
    const auto may = hn::Le(q, hn::MulAdd(t, slack, floor)), certain = hn::Lt(hn::MulAdd(q, slack, floor), t);
    // Spheres are met once, so j is not i; and |j - i| > window is one comparison of what wraps.
    const std::uint32_t i = grid_.index[p];
    const auto j = hn::LoadU(Bits(), q_.index.data() + c);
    const auto far = hn::Gt(hn::Sub(j, hn::Set(Bits(), i - window_)), hn::Set(Bits(), 2 * window_));
    auto keep = hn::And(hn::RebindMask(Bits(), may), far);
    const auto undecided = hn::AndNot(hn::RebindMask(Bits(), certain), keep);
    if (HWY_UNLIKELY(!hn::AllFalse(Bits(), undecided))) keep = decide(i, c, keep, undecided);
    hn::StoreU(hn::Set(Bits(), i), Bits(), q_.hit_i.data() + hits_);
    hits_ += static_cast<std::uint32_t>(hn::CompressStore(j, keep, Bits(), q_.hit_j.data() + hits_));
  }

  /// `keep` without those undecided that do not overlap.
  HWY_NOINLINE hn::Mask<Bits> decide(std::uint32_t i, std::uint32_t c, hn::Mask<Bits> keep, hn::Mask<Bits> undecided) {
    std::uint8_t open[8] = {}, kept[8] = {};
    hn::StoreMaskBits(Bits(), undecided, open);
    hn::StoreMaskBits(Bits(), keep, kept);
    for (std::uint32_t k = 0; k < lanes; ++k)
      if ((open[k / 8] >> k % 8 & 1) && !Robust::overlap(chain_.spheres[i], chain_.spheres[q_.index[c + k]]))
        kept[k / 8] = static_cast<std::uint8_t>(kept[k / 8] & ~(1u << k % 8));
    return hn::LoadMaskBits(Bits(), kept);
  }

  /// Reports the hits that are no neighbours.
  void flush() {
    for (std::uint32_t k = 0; k < hits_; ++k) {
      const std::uint32_t i = std::min(q_.hit_i[k], q_.hit_j[k]), j = std::max(q_.hit_i[k], q_.hit_j[k]);
      if (window_is_all_ || !chain_.neighbours(i, j)) lane_.collide(i, j);
    }
    hits_ = 0;
  }

  const ChainView& chain_;
  const SphereGrid& grid_;
  GridQueues& q_;
  PairCollector::Lane& lane_;
  std::uint32_t window_;
  bool window_is_all_;  // it decides alone who is a neighbour
  std::uint32_t size_ = 0, end_ = 0, tests_ = 0, hits_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

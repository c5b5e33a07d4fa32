// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/frames/search_runs.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/meeting-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/frames/frame_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

/// The runs that changed, all that share a group of the tree at once, against every run whose box one of
/// theirs meets.
class RunSearch {
 public:
  RunSearch(const ChainView& chain, const RunRow& row, const WideBoxTree& tree, std::uint64_t most,
            std::vector<Pair>& pairs)
      : chain_(chain), row_(row), levels_(tree.levels()), tree_(tree), most_(most), pairs_(pairs) {}

  void run() {
    const std::span<const std::uint32_t> changed = row_.changed;
    for (std::size_t k = 0, end = 0; k < changed.size(); k = end) {
      const std::uint32_t group = changed[k] / fan;
      Box around = tree_.box(changed[k]);
      for (end = k + 1; end < changed.size() && changed[end] / fan == group; ++end)
        around.join(tree_.box(changed[end]));
      runs_ = changed.subspan(k, end - k);
      descend(levels_.size() - 1, 0, around);
    }
  }

 private:
  static constexpr std::uint32_t fan = WideBoxTree::fan, run_ = RunTree::run;

  void descend(std::size_t level, std::uint32_t group, const Box& around) {
    if (pairs_.size() > most_) return;
    if (level == 0) return meet_group(group);
    for_each_lane(meeting(levels_[level][group], around),
                  [&](std::uint32_t k) { descend(level - 1, group * fan + k, around); });
  }

  void meet_group(std::uint32_t group) {
    for (const std::uint32_t of : runs_)
      for_each_lane(meeting(levels_[0][group], tree_.box(of)), [&](std::uint32_t k) {
        // Two runs that changed are met from both: once is enough.
        const std::uint32_t other = group * fan + k;
        if (!(row_.is_changed[other] && other < of)) compare(of, other);
      });
  }

  /// Bits of the places of a run that lie in the window.
  HWY_INLINE std::uint32_t filled(std::uint32_t r) const {
    const std::uint32_t first = r * run_, low = std::max(first, row_.begin) - first,
                        high = std::min(first + run_, row_.end) - first;
    return lane_bits(high) & ~lane_bits(low);
  }

  HWY_INLINE void compare(std::uint32_t of, std::uint32_t other) {
    const Sphere* const own = row_.places + std::size_t{of} * run_;
    const SphereLanes theirs(row_.places + std::size_t{other} * run_);
    Flags<run_> near[run_];
    for (std::uint32_t p = 0; p < run_; ++p) near[p] = SphereLanes::may_overlap(theirs.squares(own[p]));
    const auto any =
        ((near[0] | near[1]) | (near[2] | near[3])) | ((near[4] | near[5]) | (near[6] | near[7]));
    if (any.none()) return;
    const std::uint32_t there = filled(other);
    for_each_lane(filled(of), [&](std::uint32_t p) {
      const std::uint32_t later = of == other ? ~lane_bits(p + 1) : ~std::uint32_t{0};
      for_each_lane(near[p].bits() & there & later, [&](std::uint32_t q) {
        decide(of * run_ + p - row_.begin, other * run_ + q - row_.begin);
      });
    });
  }

  HWY_INLINE void decide(std::uint32_t i, std::uint32_t j) {
    if (!chain_.neighbours(i, j) && Robust::overlap(chain_.spheres[i], chain_.spheres[j]))
      pairs_.push_back({std::min(i, j), std::max(i, j)});
  }

  const ChainView& chain_;
  const RunRow& row_;
  const std::span<const std::vector<WideBoxTree::Group>> levels_;
  const WideBoxTree& tree_;
  const std::uint64_t most_;
  std::vector<Pair>& pairs_;
  std::span<const std::uint32_t> runs_;  ///< of one group
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Box box_of_run(const Sphere* spheres) {
  Box box = Box::around(spheres[0]);
  for (std::uint32_t k = 1; k < RunTree::run; ++k) box.join(Box::around(spheres[k]));
  return box;
}
#else
/// The least or greatest of each of the four fields, in the first four lanes.
template <class Vec, class Fold>
HWY_INLINE void fold_blocks(Vec v, const Fold& fold, float (&to)[4]) {
  const hn::DFromV<Vec> d;
  if constexpr (hn::MaxLanes(d) > 4) {
    const hn::Half<decltype(d)> half;
    fold_blocks(fold(hn::LowerHalf(half, v), hn::UpperHalf(half, v)), fold, to);
  } else {
    hn::StoreU(v, d, to);
  }
}

/// As Box::around, four numbers of a sphere side by side, of which the last means nothing.
HWY_INLINE Box box_of_run(const Sphere* spheres) {
  const hn::CappedTag<float, 16> d;
  constexpr std::size_t width = hn::MaxLanes(decltype(d)()), numbers = 4 * RunTree::run;
  const auto step = hn::Set(d, 0x1p-23f);
  auto least = hn::Zero(d), greatest = least;
  for (std::size_t k = 0; k < numbers; k += width) {
    const auto centre = hn::LoadU(d, &spheres->x + k), radius = hn::Broadcast<3>(centre);
    const auto low = hn::Sub(centre, radius), high = hn::Add(centre, radius);
    const auto below = hn::Sub(low, hn::Mul(hn::Abs(low), step)),
               above = hn::Add(high, hn::Mul(hn::Abs(high), step));
    least = k == 0 ? below : hn::Min(least, below);
    greatest = k == 0 ? above : hn::Max(greatest, above);
  }
  float low[4], high[4];
  fold_blocks(
      least, [](auto a, auto b) { return hn::Min(a, b); }, low);
  fold_blocks(
      greatest, [](auto a, auto b) { return hn::Max(a, b); }, high);
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}
#endif

}  // namespace

void set_boxes_of_runs_here(const Sphere* places, std::uint32_t first, std::uint32_t end, WideBoxTree& tree) {
  for (std::uint32_t r = first; r < end; ++r) tree.set(r, box_of_run(places + std::size_t{r} * RunTree::run));
}

void search_runs_here(const ChainView& chain, const RunRow& row, const WideBoxTree& tree, std::uint64_t most,
                      std::vector<Pair>& pairs) {
  RunSearch(chain, row, tree, most, pairs).run();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(set_boxes_of_runs_here);
HWY_EXPORT(search_runs_here);

void set_boxes_of_runs(const Sphere* places, std::uint32_t first, std::uint32_t end, WideBoxTree& tree) {
  HWY_DYNAMIC_DISPATCH(set_boxes_of_runs_here)(places, first, end, tree);
}

void search_runs(const ChainView& chain, const RunRow& row, const WideBoxTree& tree, std::uint64_t most,
                 std::vector<Pair>& pairs) {
  HWY_DYNAMIC_DISPATCH(search_runs_here)(chain, row, tree, most, pairs);
}

}  // namespace catena
#endif

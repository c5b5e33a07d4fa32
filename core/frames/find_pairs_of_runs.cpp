// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/frames/find_pairs_of_runs.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <bit>

#include "catena/core/blocks/compress_table.h"
#include "catena/core/frames/frame_kernels.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR
/// Which stretches of the window have a run that changed, in the bits of a single vector: 32 a lane, and a
/// lane for each sphere asked about at once. What it lets through is looked up.
class Stretches {
 public:
  using Tag = hn::CappedTag<std::uint32_t, 16>;
  static constexpr std::size_t width = hn::MaxLanes(Tag());

  explicit Stretches(const RunRow& row) {
    constexpr std::uint32_t run = RunTree::run;
    before_ = row.begin % run;
    const std::uint32_t first = row.begin / run, runs = (row.end + run - 1) / run - first;
    while ((runs - 1) >> by_ >= 32 * width) ++by_;
    std::uint32_t bits[width] = {};
    for (const std::uint32_t r : row.changed) {
      if (r < first || r - first >= runs) continue;  // all of its places have left
      const std::uint32_t stretch = (r - first) >> by_;
      bits[stretch / 32] |= 1u << (stretch % 32);
    }
    bits_ = hn::LoadU(Tag(), bits);
    by_ += std::countr_zero(run);
  }

  /// Bit k: a sphere of pairs[k] may be of a run that changed, of half as many pairs as there are lanes.
  HWY_INLINE std::uint32_t may(const Pair* pairs) const {
    const Tag d;
    const auto place = hn::Add(hn::LoadU(d, &pairs->i), hn::Set(d, before_));
    const auto stretch = hn::ShiftRightSame(place, static_cast<int>(by_));
    const auto word = hn::TableLookupLanes(bits_, hn::IndicesFromVec(d, hn::ShiftRight<5>(stretch)));
    const auto bit = hn::Shl(hn::Set(d, 1u), hn::And(stretch, hn::Set(d, 31u)));
    const hn::Repartition<std::uint64_t, Tag> both;
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(both, hn::Ne(hn::BitCast(both, hn::And(word, bit)), hn::Zero(both)), bytes);
    return bytes[0];
  }

 private:
  hn::Vec<Tag> bits_;
  std::uint32_t before_ = 0, by_ = 0;
};
#endif

}  // namespace

void find_pairs_of_runs_here(std::span<const Pair> pairs, const RunRow& row,
                             std::vector<std::uint32_t>& places) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  places.clear();
  if (row.changed.empty()) return;
  const auto changed = [&](const Pair& p) -> std::size_t {
    return row.is_changed[(row.begin + p.i) / RunTree::run] |
           row.is_changed[(row.begin + p.j) / RunTree::run];
  };
  std::size_t k = 0;
#if HWY_TARGET != HWY_SCALAR
  // Which pairs may be is hard to foretell, and so gathered without a branch.
  const Stretches stretches(row);
  constexpr std::size_t at_once = Stretches::width / 2, room = 4096;
  std::uint32_t may[room + 8];
  while (k + at_once <= pairs.size()) {
    std::size_t found = 0;
    for (const std::size_t end = std::min(pairs.size(), k + room); k + at_once <= end; k += at_once) {
      const std::uint32_t bits = stretches.may(&pairs[k]);
      const hn::CappedTag<std::uint32_t, 8> d;
      for (std::size_t p = 0; p < at_once; p += hn::Lanes(d)) {
        const auto order =
            hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, decltype(d)>(), &compress_table[bits][p]));
        hn::StoreU(hn::Add(order, hn::Set(d, static_cast<std::uint32_t>(k))), d, may + found + p);
      }
      found += static_cast<std::size_t>(std::popcount(bits));
    }
    std::size_t size = places.size();
    places.resize(size + found);
    for (std::size_t p = 0; p < found; ++p) {
      places[size] = may[p];
      size += changed(pairs[may[p]]);
    }
    places.resize(size);
  }
#endif
  for (; k < pairs.size(); ++k)
    if (changed(pairs[k])) places.push_back(static_cast<std::uint32_t>(k));
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(find_pairs_of_runs_here);

void find_pairs_of_runs(std::span<const Pair> pairs, const RunRow& row, std::vector<std::uint32_t>& places) {
  HWY_DYNAMIC_DISPATCH(find_pairs_of_runs_here)(pairs, row, places);
}

}  // namespace catena
#endif

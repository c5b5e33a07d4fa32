// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/frames/search_cells.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/compress-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/frames/frame_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace {

/// Each sphere of the chain against the few in the cell of its centre.
class CellSearch {
 public:
  CellSearch(const ChainView& chain, const CellsOfFew& cells, std::uint64_t most, std::vector<Pair>& pairs)
      : chain_(chain), cells_(cells), most_(most), pairs_(pairs) {}

  void run() {
    std::uint32_t i = 0;
    for (; i + width <= chain_.size && pairs_.size() <= most_; i += width) {
      look(chain_.spheres + i, i, width);
      if (found_ + width > room) flush();
    }
    if (pairs_.size() > most_) return;
    Sphere rest[width] = {};
    std::copy(chain_.spheres + i, chain_.spheres + chain_.size, rest);
    if (i < chain_.size) look(rest, i, chain_.size - i);
    flush();
  }

 private:
  using Reals = Lanes16::Tag;
  using Whole = hn::RebindToSigned<Reals>;
  using Bits = hn::RebindToUnsigned<Reals>;
  static constexpr std::uint32_t width = Lanes16::width, room = 1024;

  /// As MovedCells::along, operation by operation, so that both round alike: a lower coordinate has no higher
  /// cell.
  HWY_INLINE hn::Vec<Bits> along(int axis, hn::Vec<Reals> at) const {
    const Reals d;
    const auto cell =
        hn::Mul(hn::Sub(at, hn::Set(d, cells_.around.low[axis])), hn::Set(d, cells_.scale[axis]));
    const auto inside = hn::Min(hn::Max(cell, hn::Zero(d)), hn::Set(d, cells_.last[axis]));
    return hn::Mul(hn::BitCast(Bits(), hn::ConvertTo(Whole(), inside)), hn::Set(Bits(), cells_.step[axis]));
  }

  /// Notes which of `count` spheres lie in a cell that is filled. Who does is hard to foretell, and so found
  /// without a branch.
  HWY_INLINE void look(const Sphere* spheres, std::uint32_t first, std::uint32_t count) {
    const Reals d;
    const Bits bits;
    hn::Vec<Reals> x, y, z, radius;
    hn::LoadInterleaved4(d, reinterpret_cast<const float*>(spheres), x, y, z, radius);
    const auto between = [&](int axis, hn::Vec<Reals> at) {
      return hn::And(hn::Ge(at, hn::Set(d, cells_.around.low[axis])),
                     hn::Le(at, hn::Set(d, cells_.around.high[axis])));
    };
    const auto inside = hn::RebindMask(bits, hn::And(between(0, x), hn::And(between(1, y), between(2, z))));
    if (hn::AllFalse(bits, inside)) return;
    // Cell 0 outside, where a coordinate may have overflowed.
    const auto cell = hn::IfThenElseZero(inside, hn::Add(along(0, x), hn::Add(along(1, y), along(2, z))));
    const auto words = hn::GatherIndex(bits, cells_.filled, hn::BitCast(Whole(), hn::ShiftRight<5>(cell)));
    const auto bit = hn::Shl(hn::Set(bits, 1u), hn::And(cell, hn::Set(bits, 31u)));
    auto met = hn::And(inside, hn::Ne(hn::And(words, bit), hn::Zero(bits)));
    if (count < width) met = hn::And(met, hn::FirstN(bits, count));
    const Kept<Bits> kept(met);
    hn::StoreU(kept.compress(count_up(bits, first)), bits, sphere_ + found_);
    hn::StoreU(kept.compress(cell), bits, cell_ + found_);
    found_ += kept.size();
  }

  void flush() {
    for (std::uint32_t k = 0; k < found_ && pairs_.size() <= most_; ++k)
      meet(sphere_[k], cells_.begin[cell_[k]], cells_.begin[cell_[k] + 1]);
    found_ = 0;
  }

  HWY_INLINE void meet(std::uint32_t j, std::uint32_t entry, std::uint32_t end) {
    const Sphere b = chain_.spheres[j];
    for (; entry < end; entry += 8)
      for_each_lane(SphereLanes::may_overlap(SphereLanes(cells_.spheres + entry).squares(b)).bits() &
                        lane_bits(end - entry),
                    [&](std::uint32_t k) { decide(cells_.entries[entry + k], j, b); });
  }

  HWY_INLINE void decide(std::uint32_t i, std::uint32_t j, const Sphere& b) {
    // Two of the few are met from both: once is enough.
    if (i == j || (j < i && (cells_.is_few[j / 32] >> (j % 32) & 1))) return;
    const std::uint32_t low = std::min(i, j), high = std::max(i, j);
    if (!chain_.neighbours(low, high) && Robust::overlap(chain_.spheres[i], b)) pairs_.push_back({low, high});
  }

  const ChainView& chain_;
  const CellsOfFew& cells_;
  const std::uint64_t most_;
  std::vector<Pair>& pairs_;
  std::uint32_t found_ = 0;
  std::uint32_t sphere_[room + width], cell_[room + width];
};

}  // namespace

void search_cells_here(const ChainView& chain, const CellsOfFew& cells, std::uint64_t most,
                       std::vector<Pair>& pairs) {
  CellSearch(chain, cells, most, pairs).run();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(search_cells_here);

void search_cells(const ChainView& chain, const CellsOfFew& cells, std::uint64_t most,
                  std::vector<Pair>& pairs) {
  HWY_DYNAMIC_DISPATCH(search_cells_here)(chain, cells, most, pairs);
}

}  // namespace catena
#endif

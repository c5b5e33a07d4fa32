#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "catena/properties/mutants/mutant.h"

// Bugs of grids that search half a neighbourhood, as core/grid/ does: the cell behind along x, and four rows
// of three cells. What they have in common is right: without a bug it passes every property.
namespace catena::properties {
namespace {

/// Each pair is met once, from the cell that comes first, and reported from both ends. Coordinates beyond
/// 2^40 cells fall back to the tree.
class HalfRuns : public FaultyTree {
 public:
  using Base = HalfRuns;

 protected:
  /// A cell, and what a sphere there is compared with: cells first to last along x of the row (y, z).
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;  // z, y, x
  struct Run {
    int y, z, first, last;
  };
  using Runs = std::array<Run, 6>;
  virtual Runs runs() const {
    return {{{0, 0, 1, 1}, {1, 0, -1, 1}, {-1, 1, -1, 1}, {0, 1, -1, 1}, {1, 1, -1, 1}, no_run}};
  }
  static constexpr Run no_run{0, 0, 1, 0};
  /// How many of so many candidates are compared.
  virtual std::size_t compared(std::size_t candidates) const { return candidates; }

  void construct() override {
    FaultyTree::construct();
    double widest = 0, extent = 0;
    for (std::uint32_t i = 0; i < tree().leaves; ++i) {
      const Sphere& s = tree().bound[i];
      widest = std::max(widest, 2.0 * s.radius);
      extent = std::max({extent, std::fabs(double{s.x}), std::fabs(double{s.y}), std::fabs(double{s.z})});
    }
    side_ = widest * 1.001;  // more than all rounding
    usable_ = widest > 0x1p-100 && extent / widest < 0x1p40;
    cells_.clear();
    for (std::uint32_t i = 0; usable_ && i < tree().leaves; ++i)
      cells_.emplace_back(cell(tree().bound[i]), i);
    std::ranges::sort(cells_);
  }
  void search(const ChainView& chain, std::uint32_t i) override {
    if (!usable_) return FaultyTree::search(chain, i);
    const auto [z, y, x] = cell(chain.spheres[i]);
    candidates_.clear();
    take({z, y, x}, {z, y, x});
    std::erase_if(candidates_, [&](std::uint32_t j) { return j <= i; });
    for (const Run& run : runs())
      take({z + run.z, y + run.y, x + run.first}, {z + run.z, y + run.y, x + run.last});
    candidates_.resize(compared(candidates_.size()));
    for (const std::uint32_t j : candidates_) {
      leaf(chain, i, j);
      leaf(chain, j, i);
    }
  }

 private:
  Cell cell(const Sphere& s) const {
    const auto down = [&](float at) { return static_cast<std::int64_t>(std::floor(at / side_)); };
    return {down(s.z), down(s.y), down(s.x)};
  }

  /// Adds what is in the cells from first to last.
  void take(const Cell& first, const Cell& last) {
    for (auto at = std::ranges::lower_bound(cells_, first, {}, &Entry::first);
         at != cells_.end() && at->first <= last; ++at)
      candidates_.push_back(at->second);
  }

  using Entry = std::pair<Cell, std::uint32_t>;

  double side_ = 1;
  bool usable_ = false;
  std::vector<Entry> cells_;
  std::vector<std::uint32_t> candidates_;
};

class NoCorner final : public HalfRuns {
  Runs runs() const override {
    auto all = HalfRuns::runs();
    all[4].first = 0;
    return all;
  }
};
const RegisterMutant<NoCorner> corner{"grid-forgets-a-corner", "a half neighbourhood of 12 cells"};

class CornerTwice final : public HalfRuns {
  Runs runs() const override {
    auto all = HalfRuns::runs();
    all.back() = {-1, -1, -1, -1};
    return all;
  }
};
const RegisterMutant<CornerTwice> twice{"grid-meets-a-corner-twice", "two steps that lead to one bucket"};

class WholeVectors final : public HalfRuns {
  std::size_t compared(std::size_t candidates) const override { return candidates / 8 * 8; }
};
const RegisterMutant<WholeVectors> whole{"grid-drops-last-candidates",
                                         "vectors of eight, and the rest forgotten"};

class FullQueue final : public HalfRuns {
  std::size_t compared(std::size_t candidates) const override {
    return std::min<std::size_t>(candidates, 32);
  }
};
const RegisterMutant<FullQueue> full{"grid-queue-full",
                                     "what a crowded neighbourhood has more than a queue holds is dropped"};

}  // namespace
}  // namespace catena::properties

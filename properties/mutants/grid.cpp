#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "catena/properties/mutants/mutant.h"

// Bugs of uniform grids. Cells are as wide as the widest sphere, so a sphere reaches into the cells around
// its own.
namespace catena::properties {
namespace {

/// Candidates by a grid, decided as in the base. Coordinates beyond 2^40 cells fall back to the tree.
class Grid : public FaultyTree {
 public:
  using Base = Grid;

 protected:
  using Cell = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  static constexpr double farthest = 0x1p40;

  void construct() override {
    FaultyTree::construct();
    double widest = 0, extent = 0;
    for (std::uint32_t i = 0; i < tree().leaves; ++i) {
      const Sphere& s = tree().bound[i];
      widest = std::max(widest, 2.0 * s.radius);
      extent = std::max({extent, std::fabs(double{s.x}), std::fabs(double{s.y}), std::fabs(double{s.z})});
    }
    size_ = widest;
    usable_ = widest > 0x1p-100 && extent / widest < farthest;
    cells_.clear();
    for (std::uint32_t i = 0; usable_ && i < tree().leaves; ++i) {
      const Sphere& s = tree().bound[i];
      cells_.emplace_back(Cell{down(s.x), down(s.y), down(s.z)}, i);
    }
    std::ranges::sort(cells_);
  }
  void search(const ChainView& chain, std::uint32_t i) override {
    if (!usable_) return FaultyTree::search(chain, i);
    const Sphere& s = chain.spheres[i];
    for (std::int64_t x = first(s.x); x <= last(s.x); ++x)
      for (std::int64_t y = first(s.y); y <= last(s.y); ++y)
        for (std::int64_t z = first(s.z); z <= last(s.z); ++z)
          for (auto entry = std::ranges::lower_bound(cells_, Cell{x, y, z}, {}, &Entry::first);
               entry != cells_.end() && entry->first == Cell{x, y, z}; ++entry)
            leaf(chain, i, entry->second);
  }
  std::int64_t down(double at) const { return static_cast<std::int64_t>(std::floor(at / size_)); }
  double size() const { return size_; }

  /// The cells that a sphere at this coordinate searches. One more each way covers all rounding.
  virtual std::int64_t first(float at) const { return down(at) - 2; }
  virtual std::int64_t last(float at) const { return down(at) + 2; }

 private:
  using Entry = std::pair<Cell, std::uint32_t>;

  double size_ = 1;
  bool usable_ = false;
  std::vector<Entry> cells_;
};

class TowardZero final : public Grid {
  std::int64_t first(float at) const override { return static_cast<std::int64_t>((at - size()) / size()); }
  std::int64_t last(float at) const override { return static_cast<std::int64_t>((at + size()) / size()); }
};
const RegisterMutant<TowardZero> zero{"grid-truncates-toward-zero", "warp#1256: int() for floor()"};

/// The lower corner of the search box in binary32: far from the origin it is another cell's.
class FloatBox final : public Grid {
  std::int64_t first(float at) const override {
    const float low = at - static_cast<float>(size()), inverse = 1 / static_cast<float>(size());
    return static_cast<std::int64_t>(std::floor(low * inverse));
  }
  std::int64_t last(float at) const override {
    const float high = at + static_cast<float>(size()), inverse = 1 / static_cast<float>(size());
    return static_cast<std::int64_t>(std::floor(high * inverse));
  }
};
const RegisterMutant<FloatBox> box{"grid-box-in-float",
                                   "ArborX PR#560: the cell box loses 0.577 at 6,452,399"};

/// Half the neighbourhood, for pairs are met from both cells; but pairs within one cell are met once.
class HalfNeighbourhood final : public Grid {
  std::int64_t last(float at) const override { return down(at); }
};
const RegisterMutant<HalfNeighbourhood> half{"grid-half-neighbourhood",
                                             "each pair of cells once, each pair of spheres not"};

}  // namespace
}  // namespace catena::properties

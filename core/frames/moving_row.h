#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/frames/moved_cells.h"
#include "catena/core/frames/run_tree.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// The spheres of the last frame as a window of a longer row, and a tree over it. A frame of which some parts
/// moved, or which is shifted by some places, changes few runs of the row; pairs with a sphere of these are
/// searched again, every other pair is of two spheres none of whose bits differ and so is as it was.
class CATENA_API MovingRow {
 public:
  explicit MovingRow(std::unique_ptr<MovedCells> cells = std::make_unique<MovedCells>())
      : cells_(std::move(cells)) {}

  /// Another frame altogether. O(n); does not allocate when n has not grown.
  void hold(std::span<const Sphere> spheres);
  std::span<const Sphere> spheres() const { return {row_.data() + begin_, size_}; }

  /// The next frame differs in these ranges alone. Then search.
  void move(std::span<const Sphere> now, std::span<const SphereRange> ranges);
  /// Sphere i of the next frame is sphere i + s of this one, where both are; |s| < n. Then search.
  void shift(std::span<const Sphere> now, std::int64_t s);

  /// Fills `places` with those of the pairs of this frame, ascending, that are to be searched again.
  void find_changed(std::span<const Pair> pairs, std::vector<std::uint32_t>& places) const;
  /// Fills `found` with the pairs that have a sphere which changed. `chain` is the frame that move or shift
  /// was told of. A search for each run that changed, in the tree; `by_cells`: O(n) instead, where that can
  /// be. True when it was by cells. Nothing is changed any more then. Ends soon after there are more than
  /// `most` pairs, and some are missing: what moved onto one point has as many as its square.
  bool search(const ChainView& chain, std::vector<Pair>& found, bool by_cells,
              std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

  /// Runs that changed last; each costs about the same.
  std::uint32_t changed_runs() const { return static_cast<std::uint32_t>(changed_.size()); }
  bool tree_stands() const { return tree_stands_; }

 private:
  static constexpr std::uint32_t run = RunTree::run;

  RunRow view() const { return {row_.data(), begin_, begin_ + size_, is_changed_.data(), changed_}; }
  void change(std::uint32_t first_place, std::uint32_t end_place);
  bool search_cells(const ChainView& chain, std::vector<Pair>& found, std::uint64_t most);
  void stand_tree();
  SphereRange spheres_of(std::uint32_t of) const;

  std::vector<Sphere> row_;             ///< whole runs
  std::uint32_t begin_ = 0, size_ = 0;  ///< the window
  RunTree tree_;
  bool tree_stands_ = false;
  std::vector<std::uint32_t> changed_;  ///< runs, ascending
  std::vector<std::uint32_t> moved_;    ///< their spheres, where cells are used
  std::unique_ptr<MovedCells> cells_;
  std::vector<std::uint8_t> is_changed_;  ///< of each run
};

}  // namespace catena

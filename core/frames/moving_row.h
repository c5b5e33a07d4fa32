#pragma once
#include <cstdint>
#include <span>
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
  /// Another frame altogether. O(n); does not allocate when n has not grown.
  void hold(std::span<const Sphere> spheres);
  std::span<const Sphere> spheres() const { return {row_.data() + begin_, size_}; }

  /// The next frame differs in these ranges alone.
  void move(std::span<const Sphere> now, std::span<const SphereRange> ranges);
  /// Sphere i of the next frame is sphere i + s of this one, where both are; |s| < n.
  void shift(std::span<const Sphere> now, std::int64_t s);

  /// From the pairs of the frame before the last move or shift, by that frame's indices, to those of this
  /// one. `chain` is the frame that it was told of. `counts` of these pairs, if there are any, follow; only
  /// after a move. O(pairs) and a search for each run that changed, in the tree; `by_cells`: O(n) instead,
  /// where that can be. True when it was by cells.
  bool search(const ChainView& chain, std::vector<Pair>& pairs, std::span<std::uint32_t> counts,
              bool by_cells);

  /// Runs that changed last; each costs about the same.
  std::uint32_t changed_runs() const { return static_cast<std::uint32_t>(changed_.size()); }
  bool tree_stands() const { return tree_stands_; }

 private:
  static constexpr std::uint32_t run = RunTree::run;

  void change(std::uint32_t first_place, std::uint32_t end_place);
  bool kept(const Pair& p) const {
    return !(is_changed_[(begin_ + p.i) / run] | is_changed_[(begin_ + p.j) / run]);
  }
  void renumber(std::vector<Pair>& pairs) const;
  void refresh(std::uint32_t first_run, std::uint32_t end_run);
  bool search_cells(const ChainView& chain, std::vector<Pair>& pairs);
  void stand_tree();
  void search_runs(const ChainView& chain, std::vector<Pair>& pairs);
  void compare_runs(const ChainView& chain, std::uint32_t of, std::uint32_t other,
                    std::vector<Pair>& pairs) const;
  SphereRange spheres_of(std::uint32_t of) const;

  std::vector<Sphere> row_;
  std::uint32_t begin_ = 0, size_ = 0;  ///< the window
  std::int64_t shifted_by_ = 0;         ///< since the frame before
  RunTree tree_;
  bool tree_stands_ = false;
  std::vector<std::uint32_t> changed_;    ///< runs
  std::vector<std::uint32_t> moved_;      ///< their spheres, where cells are used
  MovedCells cells_;
  std::vector<std::uint8_t> is_changed_;  ///< of each run
};

}  // namespace catena

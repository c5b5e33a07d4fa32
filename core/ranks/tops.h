#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/ranks/block.h"
#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// The tops of the trees of all ranks: boxes of each, around blocks that are near in space, all blocks in
/// one.
class Tops {
 public:
  /// Boxes of a rank, of so many: more are finer, but all ranks read those of all.
  static std::uint32_t most_of(unsigned ranks) {
    constexpr std::uint32_t of_all = 1u << 13, most = 256, fewest = 64;
    return std::clamp(of_all / ranks, fewest, most);
  }

  /// Every rank gives its own, by boxes around blocks; for some of them they say where it is, but not all
  /// that it may touch. O(blocks) time, O(ranks) memory.
  static Tops of_all(Communicator& ranks, std::span<const Box> boxes);

  unsigned ranks() const { return static_cast<unsigned>(gathered_->size()); }
  std::uint32_t boxes_of(unsigned rank) const;
  Box box(unsigned rank, std::uint32_t k) const;
  /// Around all that the rank holds, of which there is something.
  Box around(unsigned rank) const;

 private:
  explicit Tops(Gathered gathered) : gathered_(std::move(gathered)) {}
  Gathered
      gathered_;  ///< of each rank one box around all, then the others; nothing of a rank without spheres
};

/// The tops of other ranks that one may meet, in one tree.
class ForeignTops {
 public:
  ForeignTops(const Tops& tops, unsigned own);

  bool any() const { return !rank_.empty(); }
  bool meet(const Box& box) const { return boxes_.meets(box); }
  /// visit(rank) for every other rank one of whose tops meets a box that is of this rank, by rising rank,
  /// each once.
  template <class Visit>
  void for_each_rank(const Box& box, const Visit& visit) const {
    unsigned last = none;
    boxes_.for_each_meeting(box, [&](std::uint32_t k) {
      if (rank_[k] != last) visit(last = rank_[k]);
    });
  }

 private:
  static constexpr unsigned none = ~0u;
  std::vector<unsigned> rank_;  ///< of each box
  WideBoxTree boxes_;
};

}  // namespace catena::ranks

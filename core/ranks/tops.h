#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/ranks/block.h"
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/regions.h"

namespace catena::ranks {

/// The tops of the trees of all ranks: up to 64 boxes a rank, each around blocks that are near in space. Of
/// the blocks that meet another rank's region, as no other may touch one of its blocks: so the fewer they
/// are, the finer are the boxes.
class Tops {
 public:
  static constexpr std::uint32_t most = 64;

  /// Every rank gives its own, by the boxes of those blocks; by those of some of them they say about where it
  /// is. O(blocks) time, O(ranks) memory.
  static Tops of_all(Communicator& ranks, std::span<const Box> boxes);

  unsigned ranks() const { return static_cast<unsigned>(gathered_->size()); }
  std::uint32_t boxes_of(unsigned rank) const;
  Box box(unsigned rank, std::uint32_t k) const;

 private:
  explicit Tops(Gathered gathered) : gathered_(std::move(gathered)) {}
  Gathered gathered_;
};

/// The tops of other ranks that one may meet, in one tree.
class ForeignTops {
 public:
  ForeignTops(const Tops& tops, const Regions& regions);

  bool any() const { return !rank_.empty(); }
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

#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/hierarchy/wide_box_tree.h"

namespace catena::parts {

/// Which of a row of boxes, cut into parts of consecutive ones, meet boxes of other parts. Sixty-four boxes
/// together are asked first, in a tree of such boxes.
class CATENA_API Halos {
 public:
  /// `first`: parts + 1 ascending offsets into the boxes, which outlive this.
  Halos(std::span<const Box> boxes, std::span<const std::uint32_t> first, const Team& team);

  /// About how many other parts a box meets, on average: the boxes in all halos, as a share of all. From some
  /// hundreds.
  double halo_share() const;

  /// [part]: the boxes of other parts that meet one of its own, ascending.
  std::vector<std::vector<std::uint32_t>> find() const;

 private:
  static constexpr std::uint32_t together = 64;

  std::uint32_t part_of(std::uint32_t box) const;
  std::uint32_t end_of(std::uint32_t together_k) const;
  std::uint32_t parts_met(std::uint32_t box) const;
  template <class Take>
  void compare(std::uint32_t a, std::uint32_t b, const Take& take) const;

  std::span<const Box> boxes_;
  std::span<const std::uint32_t> first_;
  const Team& team_;
  LargeVector<Box> around_;  ///< of each so many together
  WideBoxTree tree_;         ///< of these
};

}  // namespace catena::parts

#pragma once
#include <cstdint>

#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/held_part.h"

namespace catena::ranks {

/// The tops of the trees of all ranks: up to 64 boxes a rank, each around consecutive blocks, all blocks in one. The
/// largest is parted, where the highest bit of its blocks' codes changes, until there are as many.
class Tops {
 public:
  static constexpr std::uint32_t most = 64;

  /// Every rank gives its own. O(ranks) memory.
  static Tops of_all(Communicator& ranks, const HeldPart& part);

  std::uint32_t boxes_of(unsigned rank) const;
  Box box(unsigned rank, std::uint32_t k) const;
  bool meets(unsigned rank, const Box& box) const;
  bool meet(unsigned a, unsigned b) const;
  WideBoxTree tree(unsigned rank) const;

 private:
  explicit Tops(Gathered gathered) : gathered_(std::move(gathered)) {}
  Gathered gathered_;  ///< of each rank one box around all, then the others; nothing of a rank without spheres
};

}  // namespace catena::ranks

#pragma once
#include <memory>
#include <vector>

#include "catena/core/ranks/across.h"
#include "catena/core/ranks/block_message.h"
#include "catena/core/ranks/border.h"

namespace catena::ranks {

/// Compares blocks of other ranks with those of the border whose boxes they meet: all of a round in one
/// search.
class BlockComparison {
 public:
  BlockComparison(const HeldPart& part, const Border& border, std::vector<Counted>& counted, KeptPairs& kept);

  /// Whether a block with this box may touch a sphere of the border's blocks from the `first` on. Those that
  /// it may are compared with what comes next.
  bool expect(const Box& box, std::uint32_t first);
  /// What came of those blocks, by the same `first`.
  void take(ByteReader& in, std::uint32_t first) { far_.take(in, part_.rule(), first); }
  /// Adds to `counted` and to `kept`; returns how many blocks that came have a sphere that touches one of the
  /// part's, neighbours too. What came is forgotten, and what was expected.
  std::uint64_t compare();

 private:
  void gather_own();
  void visit(std::uint32_t own, std::uint32_t far);
  void count_found();

  const HeldPart& part_;
  const Border& border_;
  std::vector<Counted>& counted_;
  KeptPairs& kept_;

  std::vector<std::uint8_t> expected_;  // [block of the border]
  std::vector<std::uint32_t> near_;     // of those the blocks, then
  FarBlocks far_;
  struct Own {
    SphereId id;
    std::uint32_t sphere, block;  // of the part, of the border
  };
  std::vector<Own> own_;                   // their spheres
  std::vector<std::uint64_t> collisions_;  // [of own_, then of far_]
  std::vector<std::uint8_t> touches_;      // [block of far_]
  std::unique_ptr<Variant> search_;
};

}  // namespace catena::ranks

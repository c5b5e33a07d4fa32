#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "catena/core/ranks/across.h"
#include "catena/core/ranks/block_message.h"
#include "catena/core/ranks/border.h"
#include "catena/core/ranks/meet_border.h"

namespace catena::ranks {

/// Compares blocks of other ranks with those of the border whose boxes they meet: one after the other, or,
/// where they meet too many, all that is left of a round in one search.
class BlockComparison {
 public:
  /// `meetings`: see AcrossOptions.
  BlockComparison(const HeldPart& part, const Border& border, std::uint32_t meetings,
                  std::vector<Counted>& counted, KeptPairs& kept);

  /// What came of those blocks, by the same `compared`.
  void take(ByteReader& in, std::uint32_t compared) { far_.take(in, part_.rule(), compared); }
  /// Adds to `counted` and to `kept`; returns how many blocks that came have a sphere that touches one of the
  /// part's, neighbours too. What came is forgotten.
  std::uint64_t compare();

 private:
  /// A sphere of the border: eight times the number of its block there, and where it is in that.
  using Slot = std::uint64_t;

  void decide(const Meeting& meeting);
  void search_from(std::uint32_t far_block);
  std::vector<std::uint32_t> own_blocks_for(std::uint32_t far_block) const;
  void search(std::span<const std::uint32_t> own_blocks, std::uint32_t first_far);
  void overlap(Slot own, std::uint32_t far);
  void count(Slot own, SphereId id, std::uint32_t far, SphereId far_id);
  bool are_neighbours(Slot own, std::uint32_t far) const;
  void count_found();

  const HeldPart& part_;
  const Border& border_;
  const std::uint32_t meetings_;
  std::vector<Counted>& counted_;
  KeptPairs& kept_;

  FarBlocks far_;
  std::vector<std::uint32_t> own_count_, far_count_;  // [slot] and [sphere of far_]: of this round
  std::vector<std::uint8_t> touches_;                 // [block of far_]
  LargeVector<Meeting> near_;
  std::unique_ptr<Variant> search_;
};

}  // namespace catena::ranks

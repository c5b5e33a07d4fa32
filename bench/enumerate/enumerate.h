#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "catena/bench/enumerate/other_lattice.h"
#include "catena/bench/enumerate/published.h"
#include "catena/bench/enumerate/walk.h"
#include "catena/core/strategy/variant.h"

namespace catena::bench {

/// Which walks are asked about: every sphere of a walk has this radius, in steps of the lattice.
struct WalkQuestion {
  int dimensions = 3;  ///< 2 square, 3 cubic
  float radius = 0.5f;
  bool contacts = false;  ///< also count pairs that touch at radius 1/2, in walks that are free at `radius`
  int steps = 8;          ///< of the longest walks, 1 to most_steps()
  const OtherLattice* other =
      nullptr;  ///< instead of the square or cubic lattice; its contacts are not counted

  /// The published table that a walk without collisions at this radius belongs to: below 1/2 points collide
  /// where they coincide, below sqrt(1/2) where they are adjacent too. Beyond, nobody published one, nor from
  /// 1/2 on for other lattices.
  std::optional<WalkTable> table() const;
  int most_steps() const { return other ? OtherWalk::most_steps : Walk::most_steps; }
};

/// All walks of a length without a collision, whole classes counted.
struct WalkCount {
  int steps = 0;
  std::uint64_t walks = 0;
  std::uint64_t contacts = 0;  ///< 0 unless asked for
};

/// Counts walks of 1 to question.steps steps, one entry a length. Each walk is a strand of its own among
/// thousands in one chain, too far apart to meet, and the variant alone says which strands collide; a free
/// walk has free beginnings, so only free walks are prolonged. Memory O(steps); time grows by 4.7 a step
/// (cubic). Throws InputError for a question out of its ranges or of radii that its lattice's points do not
/// tell, and what the variant throws.
std::vector<WalkCount> enumerate_walks(Variant& variant, const WalkQuestion& question);

/// One chain of these walks, which have equal lengths: each a strand, apart from the others by more than they
/// reach. The radius is in steps.
Chain chain_of_walks(const std::vector<Walk>& walks, float radius);
Chain chain_of_walks(const std::vector<OtherWalk>& walks, float radius);

}  // namespace catena::bench

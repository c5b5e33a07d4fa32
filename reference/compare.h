#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// A pair that was decided wrongly, and how near to touching it is.
struct WrongPair {
  Pair pair;
  bool missing;   ///< false: invented
  double margin;  ///< |q - t| / t; infinite for two different points
};

/// What is wrong with an answer. All zero for the right one.
struct Comparison {
  static constexpr std::size_t shown = 8;  ///< most wrong pairs kept as examples

  std::uint64_t pairs = 0;         ///< different pairs in the answer; its pair_count when it is counts only
  std::uint64_t missing = 0;       ///< colliding pairs that are not in it
  std::uint64_t invented = 0;      ///< pairs in it that do not collide
  std::uint64_t neighbours = 0;    ///< those of `invented` that are neighbours
  std::uint64_t repeated = 0;      ///< pairs given again
  std::uint64_t malformed = 0;     ///< entries that are not i < j < n
  std::uint64_t wrong_counts = 0;  ///< spheres whose count is not the right one
  std::uint64_t inconsistent_counts = 0;  ///< spheres whose count is not that of the answer's own pairs
  bool wrong_total = false;         ///< pair_count or found contradicts pairs (counts only: the right total)
  double worst_margin = 0;          ///< largest margin of a wrong decision, neighbours apart
  std::vector<WrongPair> examples;  ///< the first few wrong pairs, sorted

  /// The right pairs, each once, with the right counts.
  bool right() const;
  /// No defect that arithmetic could not excuse: every entry i < j < n and given once, no neighbours.
  bool well_formed() const { return repeated == 0 && malformed == 0 && neighbours == 0; }
};

/// Compares an answer with the right one by their pairs, counts and totals; by counts and totals alone when
/// `exact` is counts only. O(p log p + n) for p pairs.
Comparison compare(const Chain& chain, const Answer& exact, const Collisions& found);

/// The part that needs no pairs: counts and totals against the right ones. O(n).
Comparison compare_counts(const Answer& exact, const Collisions& found);

}  // namespace catena::reference

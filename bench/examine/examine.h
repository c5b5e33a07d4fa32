#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/reference/answer.h"

namespace catena::bench {

/// The parents of one level of a hierarchy.
struct LevelExamined {
  std::uint32_t level = 0;  ///< 1: parents of leaves only; a parent is one above the higher of its children
  std::uint64_t parents = 0;
  std::uint64_t failing = 0;  ///< those that do not enclose one of their children, in exact arithmetic
  double worst_shortfall =
      0;  ///< how far a child sticks out, relative to its parent's radius; may be infinite
};

/// The paper's arithmetic under the lens, on one chain.
struct Examination {
  std::vector<LevelExamined> levels;  ///< from the leaves up
  LevelExamined all;                  ///< every level together
  std::uint64_t missing = 0;          ///< colliding pairs that are not found
  std::uint64_t lost_by_tree = 0;     ///< of them, those that the same arithmetic finds when it is asked: a
                                      ///< bound that does not enclose hid them
  std::uint64_t invented = 0;         ///< pairs found that do not collide
};

/// Builds and searches with aCPU2+CPU2 in "literal" or "double". `exact` has pairs. O(n log n + pairs log
/// pairs). Throws PairLimitExceeded when the arithmetic invents a flood.
Examination examine(const std::string& arithmetic, const Chain& chain, const reference::Answer& exact);

}  // namespace catena::bench

#pragma once
#include <limits>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// The pair that is nearest to changing its mind: the conditioning of a chain.
struct Tightest {
  Pair pair{0, 0};  ///< meaningless while the margin is infinite
  double margin =
      std::numeric_limits<double>::infinity();  ///< infinite: every pair is a neighbour or two points
};

struct AllPairs {
  Answer answer;
  Tightest tightest;  ///< over all pairs that are not neighbours, colliding or not
};

/// Every pair of the chain, one by one: the reference of the references. Want::any is answered like
/// Want::counts. `tightest` has the smallest margin of all pairs to a relative 2^-39, and exactly the
/// smallest below 2^-9. O(n^2) time, O(n + pairs) memory. Throws PairLimitExceeded with the true number.
AllPairs all_pairs(const Chain& chain, const Request& request = {});

/// The margin of each of these pairs, in their order. O(1) each. Indices must be below chain.size().
std::vector<double> margins(const Chain& chain, std::span<const Pair> pairs);

}  // namespace catena::reference

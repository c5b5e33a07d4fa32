#pragma once
#include <optional>

#include "catena/core/chain/chain.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// What differs between an answer of ranks and the exact reference, over all ranks.
struct RankComparison {
  std::uint64_t missing = 0, invented = 0;  ///< pairs
  std::uint64_t repeated = 0, wrong_counts = 0;
  bool wrong_total = false;

  bool right() const { return missing + invented + repeated + wrong_counts == 0 && !wrong_total; }
};

/// Rank 0, which alone has the chain, finds the exact answer by itself and sends each rank what it ought to
/// have, in the box where there is one. All ranks call it and get the same.
RankComparison compare_with_reference(Communicator& ranks, const std::optional<Chain>& chain,
                                      const RankAnswer& answer, const PeriodicBox* box = nullptr);

}  // namespace catena::ranks

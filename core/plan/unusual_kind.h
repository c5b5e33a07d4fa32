#pragma once
#include <string>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"

namespace catena {

/// A kind of chain for which another variant is quicker than the one that is quickest for most, told by what
/// is known since its numbers were checked, and by some spheres, which say whether its order follows its
/// place in space. Every variant gives the same answer.
struct CATENA_API UnusualKind {
  std::string variant;   ///< the quicker one
  std::string reason;    ///< with which figure decides
  bool threads = false;  ///< of as many threads as the usual variant; else of one
  double times = 1;      ///< about what a sphere takes a host, of what it takes in a usual chain

  /// Null for a usual chain, and where nothing is known of it, {}. Where its spheres are null few kinds can
  /// be told. `frames_follow`: the chain will move, and what is sorted once serves several frames. O(log n),
  /// and O(strands) of up to 6,000 spheres.
  static const UnusualKind* of(const ChainView& chain, bool frames_follow = false);
};

}  // namespace catena

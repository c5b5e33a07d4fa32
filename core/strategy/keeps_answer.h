#pragma once
#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// What a variant is, too, that holds its answer from frame to frame; those that the registry makes are, to
/// whatever use. Film calls it.
class CATENA_API KeepsAnswer {
 public:
  virtual ~KeepsAnswer() = default;

  /// As Variant::find, into an answer of its own, of which what the frame did not change is not written
  /// again: an unmoved frame that update was told of takes O(1). Pairs may be there where counts are asked
  /// for. Valid until the next build, update or find.
  virtual const Collisions& find_kept(const Chain& chain, const Request& request) = 0;
};

}  // namespace catena

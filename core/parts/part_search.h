#pragma once
#include "catena/core/chain/chain.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"

namespace catena::parts {

/// What searches one part at a time: a device, or a variant of the host. One thread at a time.
class PartSearch {
 public:
  virtual ~PartSearch() = default;
  /// Moves a part there and builds. Throws CapacityError where there is no room for it.
  virtual void build(const Chain& whole, const LocalChain& part, const Request& request) = 0;
  /// As Variant::find on the part of the last build, in its numbers.
  virtual void find(const LocalChain& part, const Request& request, Collisions& result) = 0;
  /// Gives back all memory; a build comes next.
  virtual void drop() = 0;
  /// Of the last build and find.
  virtual Timings timings() const = 0;
};

}  // namespace catena::parts

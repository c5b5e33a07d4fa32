#pragma once
#include <cstdint>
#include <span>

#include "catena/core/chain/chain.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/parts/local_chain.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"

namespace catena::parts {

/// Where a build leaves boxes around groups of spheres, as it reads them anyway.
struct BoxesWanted {
  std::uint32_t group = 1;  ///< spheres of each, which divides the number of the part's first sphere
  Box* boxes = nullptr;     ///< of the part, which is one run; nullptr: none
};

/// What searches one part at a time: a device, or a variant of the host. One thread at a time.
class PartSearch {
 public:
  virtual ~PartSearch() = default;
  /// How it is to know neighbours.
  virtual LocalChain::Neighbours knows() const = 0;
  /// Moves a part there and builds. Throws CapacityError where there is no room for it.
  virtual void build(const Chain& whole, const LocalChain& part, const Request& request,
                     const BoxesWanted& boxes) = 0;
  /// As Variant::find on the part of the last build, in its numbers, for its own spheres alone, whose counts
  /// go to `count` unless any pair will do; result.count may be empty.
  virtual void find(const LocalChain& part, const Request& request, Collisions& result,
                    std::span<std::uint32_t> count) = 0;
  /// Gives back all memory; a build comes next.
  virtual void drop() = 0;
  /// Of the last build and find.
  virtual Timings timings() const = 0;
};

}  // namespace catena::parts

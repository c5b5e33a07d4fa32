#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// Searches a small part of a chain for one colliding pair, before all of it is built for a search: where
/// contacts are between spheres not far along the chain, and all over it, one is there. What it gives is a
/// colliding pair of the chain; nothing found proves nothing.
class CATENA_API PartLook {
 public:
  static constexpr std::uint32_t parts =
      256;  ///< of the chain; one is searched, which costs as little of a search
  static constexpr std::uint32_t least = 1024 * parts;
  /// Below, all is built as quickly.
  static bool pays(std::uint32_t n) { return n >= least; }

  /// A colliding pair i < j with i in `queries`, under an index window. O(n / parts log n). Does not allocate
  /// once warm.
  std::optional<Pair> look(const ChainView& chain, const SphereRange& queries);

 private:
  std::unique_ptr<Variant> search_;  ///< made when it is first needed
  Chain shape_, part_;               ///< an open strand as long as the part; that of the spheres
  Collisions found_;
};

}  // namespace catena

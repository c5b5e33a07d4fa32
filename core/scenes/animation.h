#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {

/// A sequence of chains of the same tube: the frames of a scene, or the single frame of a file.
class Animation {
 public:
  virtual ~Animation() = default;
  virtual std::uint32_t frames() const { return 1; }
  /// The chain of frame f < frames(). Deterministic; O(n).
  virtual Chain frame(std::uint32_t f) const = 0;
  /// s where it is known that sphere i of frame f is bit for bit sphere i + s of frame f - 1, wherever both
  /// are (see Moved::along); 0: not known. 0 < f < frames().
  virtual std::int64_t shift(std::uint32_t f) const {
    static_cast<void>(f);
    return 0;
  }
};

}  // namespace catena

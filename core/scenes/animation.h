#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {

/// A chain whose spheres can be made some at a time, so that none needs to hold all.
struct ChainByStretches {
  std::uint32_t size = 0;
  Strands strands;  ///< as Chain takes them
  Exclusion exclusion;
  std::function<std::vector<Sphere>(std::uint32_t first, std::uint32_t end)> spheres;
};

/// A sequence of chains of the same tube: the frames of a scene, or the single frame of a file.
class Animation {
 public:
  virtual ~Animation() = default;
  virtual std::uint32_t frames() const { return 1; }
  /// The chain of frame f < frames(). Deterministic; O(n).
  virtual Chain frame(std::uint32_t f) const = 0;
  /// The same chain by stretches, with the memory of what is asked for; nothing where it has to be made
  /// whole.
  virtual std::optional<ChainByStretches> in_stretches(std::uint32_t f) const {
    static_cast<void>(f);
    return {};
  }
  /// s where it is known that sphere i of frame f is bit for bit sphere i + s of frame f - 1, wherever both
  /// are (see Moved::along); 0: not known. 0 < f < frames().
  virtual std::int64_t shift(std::uint32_t f) const {
    static_cast<void>(f);
    return 0;
  }
};

}  // namespace catena

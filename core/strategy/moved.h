#pragma once
#include <cstdint>
#include <span>

#include "catena/core/export.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// Which spheres of a chain differ from those of the last build or update: everything, or some ranges, or all
/// but in their places. A view; the ranges are the caller's, ascend and do not overlap. What lies outside of
/// them is the same, bit for bit.
class CATENA_API Moved {
 public:
  Moved() = default;  ///< everything may have moved
  explicit Moved(std::span<const SphereRange> ranges) : everything_(false), ranges_(ranges) {}

  /// The chain went on along itself: sphere i is bit for bit what sphere i + s was, wherever both are. A
  /// variant that makes no use of it takes everything as moved.
  static Moved along(std::int64_t s) {
    Moved moved;
    moved.shift_ = s;
    return moved;
  }

  bool everything() const { return everything_; }
  /// Means nothing when everything may have moved.
  std::span<const SphereRange> ranges() const { return ranges_; }
  /// The s of along; 0 where it is not known, or there is none.
  std::int64_t shift() const { return shift_; }

 private:
  bool everything_ = true;
  std::int64_t shift_ = 0;
  std::span<const SphereRange> ranges_;
};

}  // namespace catena

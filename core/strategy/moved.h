#pragma once
#include <span>

#include "catena/core/export.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// Which spheres of a chain differ from those of the last build or update: everything, or some ranges. A
/// view; the ranges are the caller's, ascend and do not overlap. What lies outside of them is the same, bit
/// for bit.
class CATENA_API Moved {
 public:
  Moved() = default;  ///< everything may have moved
  explicit Moved(std::span<const SphereRange> ranges) : everything_(false), ranges_(ranges) {}

  bool everything() const { return everything_; }
  std::span<const SphereRange> ranges() const {
    return ranges_;
  }  ///< means nothing when everything may have moved

 private:
  bool everything_ = true;
  std::span<const SphereRange> ranges_;
};

}  // namespace catena

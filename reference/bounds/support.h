#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "catena/core/hierarchy/bound.h"

namespace catena::reference {

/// Ends between which numbers certainly lie; infinite where nothing is known.
struct Range {
  double low, high;
};

/// What binary64 is certain of about where a proper bound ends. Slabs are bounded along their own directions
/// and, by the first three when these are independent and finite, along all others. Slabs must outlive it.
class Support {
 public:
  explicit Support(const AnyBound& bound);

  /// A range of direction . (p - origin) over all points p of the bound. For spheres, capsules and boxes, and
  /// slabs along their own directions, it is too wide by less than 2^-45 of the greatest term only.
  Range along(const Vector64& direction, const Vector64& origin) const;

  /// Directions of the edges of a capsule (one), a box or the first three slabs, about; of no special length.
  std::span<const Vector64> edges() const { return {edges_.data(), edge_count_}; }

 private:
  void measure(const Slabs64& slabs);
  Range along(const Vector64& direction, const Vector64& origin, const Capsule64& c) const;
  Range along(const Vector64& direction, const Vector64& origin, const Box64& b) const;
  Range along(const Vector64& direction, const Vector64& origin, const Slabs64& s) const;

  AnyBound bound_;
  std::array<Vector64, 3> edges_{};
  std::size_t edge_count_ = 0;
  double size_ = 0;  ///< at least |coordinate| of p - origin over all points p of the first three slabs
};

}  // namespace catena::reference

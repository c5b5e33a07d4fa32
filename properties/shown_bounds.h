#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "catena/core/strategy/variant.h"

namespace catena::properties {

/// Every (parent, child) that a variant shows of its last build, with the numbers of their bounds.
class ShownBounds {
 public:
  explicit ShownBounds(const Variant& variant);
  /// The nodes that its evidence names.
  static ShownBounds of_evidence(const Variant& variant);

  /// (parent id, child id), sorted: the shape of the tree.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges() const { return edges_; }
  /// The same bounds in the same order; NaN of a literal parent equals NaN.
  bool same_bits(const ShownBounds& other) const;

 private:
  ShownBounds() = default;

  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  std::vector<double> numbers_;  ///< kind and numbers of each bound, as shown
};

}  // namespace catena::properties

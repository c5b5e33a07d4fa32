#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/strategy/variant.h"

namespace catena::properties {

/// Every (parent, child) that a variant shows of its last build, with the numbers of their bounds.
class ShownBounds {
 public:
  explicit ShownBounds(const Variant& variant);
  /// The nodes that its evidence names.
  static ShownBounds of_evidence(const Variant& variant, const Chain& chain);

  /// (parent id, child id), sorted: the shape of the tree.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges() const;
  /// The same bounds, in whatever order they were shown; NaN of a literal parent equals NaN.
  bool same_bits(const ShownBounds& other) const { return !difference(other); }
  /// Where the bounds are not the same, in words.
  std::optional<std::string> difference(const ShownBounds& other) const;

 private:
  struct Edge {
    std::uint32_t parent, child;
    std::vector<double> numbers;  ///< kind and numbers of both bounds
  };
  class Collector;
  ShownBounds() = default;
  void sort();

  std::vector<Edge> edges_;  ///< sorted
};

}  // namespace catena::properties

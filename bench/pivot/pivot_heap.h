#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace catena::bench {

/// The shape of a binary tree over the points of a walk, nodes as in a heap: 1 is the root, 2k and 2k + 1 are
/// below k, the last level are the leaves, runs of 4 to 8 points (fewer where there are fewer).
struct PivotHeap {
  static constexpr std::uint32_t most_in_leaf = 8;
  static constexpr std::size_t most_levels = 32;

  std::uint32_t size = 0, leaves = 1;
  int leaf_bits = 0;  ///< leaves is 2 to this power

  PivotHeap() = default;
  explicit PivotHeap(std::uint32_t points) : size(points) {
    while (std::uint64_t{leaves} * most_in_leaf < points) leaves *= 2, ++leaf_bits;
  }
  bool is_leaf(std::uint32_t node) const { return node >= leaves; }
  std::uint32_t first_point(std::uint32_t leaf) const {
    return static_cast<std::uint32_t>(std::uint64_t{leaf - leaves} * size >> leaf_bits);
  }
  /// The first point below a node.
  std::uint32_t first_below(std::uint32_t node) const {
    return first_point(node << (std::bit_width(leaves) - std::bit_width(node)));
  }
  /// The first point beyond a node.
  std::uint32_t end_below(std::uint32_t node) const {
    return first_point((node + 1) << (std::bit_width(leaves) - std::bit_width(node)));
  }
  std::uint32_t leaf_of(std::uint32_t point) const {
    auto leaf = leaves + static_cast<std::uint32_t>((std::uint64_t{point} << leaf_bits) / size);
    while (first_point(leaf + 1) <= point) ++leaf;  // rounded down, it may be one too early
    return leaf;
  }
  /// From the root to a leaf, both counted.
  std::size_t levels() const { return static_cast<std::size_t>(leaf_bits) + 1; }
  /// The node of a level, the root's is 0, on the way to a leaf.
  std::uint32_t on_way(std::uint32_t leaf, std::size_t level) const { return leaf >> (levels() - 1 - level); }
};

}  // namespace catena::bench

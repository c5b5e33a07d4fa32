#pragma once
#include <cstdint>

#include "catena/core/executor/large_vector.h"
#include "catena/core/space_tree/box_levels.h"
#include "catena/core/space_tree/kept_order.h"
#include "catena/core/space_tree/space_order.h"

namespace catena {

/// Single spheres in the order of space, for where much is near, or radii are mixed: sorted by class of size
/// and along a space-filling curve, sixteen that follow one another a node, in boxes along the axes of space;
/// sixteen nodes the next, and so on. A place in that order is a *place*. 22 bytes a sphere, 26 of some
/// of a chain, and 8 or 16 that the sort takes. The spheres' next frame may be put into the same order; nodes
/// are made anew.
struct SphereTree {
  static constexpr std::uint32_t group = 16;
  /// Fields of a node's spheres: x y z radius; what fills the last node up has no x (NaN), which meets
  /// nothing.
  static constexpr std::uint32_t sphere_fields = 4;
  /// Fields of sixteen boxes: low x y z, high x y z.
  static constexpr std::uint32_t box_fields = 6;

  float doubt = 1;  ///< as BlockTree::doubt
  std::uint32_t spheres = 0;
  LargeVector<float> fields;         ///< of each node's spheres, sixteen numbers a field
  LargeVector<std::uint32_t> index;  ///< [place]: of the sphere in the chain
  /// [level]: boxes of nodes, of sixteen nodes, and so on to a single group; groups of sixteen.
  BoxLevels boxes;
  SpaceOrder order;
  KeptOrder kept;
  LargeVector<std::uint32_t> only;  ///< of these spheres of the chain; empty where of all

  std::uint32_t nodes() const { return (spheres + group - 1) / group; }
  /// Boxes of a level that enclose something.
  std::uint32_t count(std::size_t level) const {
    std::uint32_t count = nodes();
    for (; level > 0; --level) count = (count + group - 1) / group;
    return count;
  }
  const float* fields_of(std::uint32_t node) const {
    return fields.data() + std::size_t{node} * group * sphere_fields;
  }
  float* fields_of(std::uint32_t node) { return fields.data() + std::size_t{node} * group * sphere_fields; }
  const float* boxes_of(std::size_t level, std::uint32_t g) const {
    return boxes[level].data() + std::size_t{g} * group * box_fields;
  }
  float* boxes_of(std::size_t level, std::uint32_t g) {
    return boxes[level].data() + std::size_t{g} * group * box_fields;
  }
};

}  // namespace catena

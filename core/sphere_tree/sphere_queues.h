#pragma once
#include <cstdint>

#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// What a search of a SphereTree works on: groups of nodes that a group's box meets, nodes that a node's box
/// meets, tests of a sphere against a node, and the pairs that a test leaves. Flat lists instead of nested
/// loops, whose ends are hard to foretell.
struct SphereQueues {
  static constexpr std::size_t group = 16;  ///< that much may be added at once, past a limit
  static constexpr std::size_t group_limit = 64, node_limit = 48, test_limit = 256, hit_limit = 1024;

  struct Test {
    std::uint32_t place;  ///< of the sphere
    std::uint32_t node;   ///< all of whose spheres it is tested against
  };

  // Since this was made:
  std::uint64_t nodes_done = 0;  ///< two nodes
  std::uint64_t tests_done = 0;  ///< a sphere against a vector of others, as in GridQueues
  std::uint64_t open_done = 0;   ///< pairs that binary32 left open
  LargeVector<std::uint32_t> groups = LargeVector<std::uint32_t>(group_limit);
  LargeVector<float> boxes = LargeVector<float>(group_limit * 6);  ///< of these, as SphereTree::boxes
  LargeVector<std::uint32_t> nodes = LargeVector<std::uint32_t>(node_limit + group);
  /// A vector that is stored may pass the last.
  LargeVector<Test> tests = LargeVector<Test>(test_limit + 2 * group);
  LargeVector<Pair> hits = LargeVector<Pair>(hit_limit + group);
};

}  // namespace catena

#pragma once
#include <cstdint>

namespace catena {

/// What evidence names a node of whose spheres some are left to another search, which has all pairs of two of
/// them: a node of those, and one of ours. Either may be none.
struct NodeParts {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  std::uint32_t ours = none, others = none;

  /// All that is below it are one or the other.
  static NodeParts one(std::uint32_t id, bool others) {
    return others ? NodeParts{none, id} : NodeParts{id, none};
  }

  /// found(id, id) for pairs of parts, but of two of the other search's.
  template <class Found>
  static void for_each_pair(const NodeParts& a, const NodeParts& b, const Found& found) {
    if (a.ours != none && b.ours != none) found(a.ours, b.ours);
    if (a.ours != none && b.others != none) found(a.ours, b.others);
    if (a.others != none && b.ours != none) found(a.others, b.ours);
  }
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/hierarchy/bounds_visitor.h"

namespace catena::reference {

/// Faults of a hierarchy as it was shown.
struct BoundTreeFaults {
  std::uint64_t bounds = 0;          ///< (parent, child) seen
  std::uint64_t unenclosed = 0;      ///< children that stick out of their parent, or have a sphere that does
  double worst_shortfall = 0;        ///< of those, over the size of the parent
  std::uint64_t foreign_leaves = 0;  ///< leaves that are not the chain's sphere of their index
  std::uint64_t misplaced =
      0;  ///< nodes with two parents, in a cycle, with an id of 8n or more, or shown with two bounds
  bool sound() const { return unenclosed == 0 && foreign_leaves == 0 && misplaced == 0; }
};

/// Hierarchies of bounds of any kind, gathered from their (parent, child) pairs. When they are sound, every
/// node encloses every sphere below it, in exact arithmetic. About 64 bytes a node.
class BoundTree {
 public:
  /// `chain` must outlive the tree.
  explicit BoundTree(const Chain& chain);

  /// What is added from now on is another tree: spheres that have a parent may have one more in it. Inner
  /// nodes have one in all.
  void begin_tree() { ++trees_; }
  void add(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id, const AnyBound& child);
  /// Call once when all were added. `nested`: the tree promises that parents enclose the bounds of their
  /// children, and is held to it; else each sphere is held against each of its ancestors, but where bounds
  /// enclose bounds anyway. O(nodes), and O(1) a sphere and ancestor.
  void check(bool nested);

  std::size_t size() const { return nodes_.size(); }  ///< one past the greatest id that has a place
  bool knows(std::uint32_t id) const { return id < nodes_.size() && nodes_[id].known; }
  std::optional<std::uint32_t> parent(std::uint32_t id) const;
  /// A sphere below a node of another tree than that of parent().
  struct Further {
    std::uint32_t sphere, parent;
    bool nested = false;  ///< it is within that node's bound
  };
  const std::vector<Further>& further() const { return further_; }
  /// The nodes that are known, children before their parents; those in a cycle are left out. After check().
  const std::vector<std::uint32_t>& upwards() const { return upwards_; }
  /// True when no point is in the bounds of both, in exact arithmetic.
  bool separate(std::uint32_t a, std::uint32_t b) const;
  const BoundTreeFaults& faults() const { return faults_; }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  struct alignas(64) Node {
    Sphere64 sphere{};  ///< most bounds are; others lie apart
    std::uint32_t parent = none;
    std::uint32_t other = none;  ///< index into others_
    std::uint32_t open_children = 0;
    std::uint32_t tree = 0;  ///< of a sphere: the last that has it
    bool known = false, is_sphere = false;
    bool nested = false;      ///< its bound is within its parent's
    bool sticks_out = false;  ///< counted as unenclosed
  };
  Node* show(std::uint32_t id, const AnyBound& bound);
  bool store(Node& node, const AnyBound& bound);
  AnyBound bound(const Node& node) const;
  void order();
  void check_edges();
  void check_spheres();
  void check_above(const Sphere64& sphere, Node& node, std::uint32_t parent, bool nested);
  void stick_out(Node& node, double shortfall);

  const Chain& chain_;
  const std::uint32_t leaves_;
  std::vector<Node> nodes_;
  std::vector<AnyBound> others_;
  std::deque<std::vector<Slab>> slabs_;  ///< what others_ refer to
  std::vector<std::uint32_t> upwards_;
  std::vector<Further> further_;
  std::uint32_t trees_ = 0;
  BoundTreeFaults faults_;
};

}  // namespace catena::reference

#pragma once
#include <cstdint>
#include <memory>

#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// Child links of one node (Fig. 6). Leaves have none.
struct Links {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  CATENA_HD static constexpr Links of_leaf() { return {none, none}; }
  std::uint32_t left, right;
  friend bool operator==(const Links&, const Links&) = default;
};

/// The paper's tree as plain pointers, valid in one memory space: two arrays of 2n - 1 slots (Fig. 5). Slots
/// 0..n-1 are the leaves, slot i the chain's sphere i; inner nodes follow in the builder's own order.
template <class Bound>
struct HierarchyView {
  Bound* bound;
  Links* links;
  std::uint32_t leaves;  ///< n; 0 means an empty tree without a root
  std::uint32_t root;    ///< slot of the root
  std::uint32_t height;  ///< levels on the longest way from root to leaf, 1 for a single leaf

  CATENA_HD std::uint32_t size() const { return leaves == 0 ? 0 : 2 * leaves - 1; }
  CATENA_HD bool is_leaf(std::uint32_t slot) const { return slot < leaves; }
};

/// Owner of the arrays on the host. Keeps its capacity, so that building again for n spheres does not
/// allocate.
template <class Bound>
class Hierarchy {
 public:
  /// Room for n leaves; slots are left as they are. Throws std::bad_alloc.
  HierarchyView<Bound> reset(std::uint32_t n) {
    const std::size_t slots = n == 0 ? 0 : 2 * std::size_t{n} - 1;
    if (slots > capacity_) {
      bound_ = std::make_unique_for_overwrite<Bound[]>(slots);
      links_ = std::make_unique_for_overwrite<Links[]>(slots);
      capacity_ = slots;
    }
    return {bound_.get(), links_.get(), n, 0, n == 0 ? 0u : 1u};
  }

 private:
  std::size_t capacity_ = 0;
  std::unique_ptr<Bound[]> bound_;
  std::unique_ptr<Links[]> links_;
};

/// Shows the paper's tree; ids are slots.
template <class Bound>
void show_bounds(const HierarchyView<Bound>& tree, BoundsVisitor& visitor) {
  const auto shown = [&](std::uint32_t slot) {
    const Bound& b = tree.bound[slot];
    return Sphere64{b.x, b.y, b.z, b.radius};
  };
  visitor.tree(TreeFacts{tree.height, true});
  for (std::uint32_t slot = tree.leaves; slot < tree.size(); ++slot) {
    const Links children = tree.links[slot];
    visitor.edge(slot, shown(slot), children.left, shown(children.left));
    visitor.edge(slot, shown(slot), children.right, shown(children.right));
  }
}

/// What traversals keep a stack for; a higher hierarchy is refused when it is built. n < 2^31 gives at most
/// 32 levels by pairs (aCPU2), at most 9 a stage of aGPU2 and 4 stages, that is 37.
inline constexpr std::uint32_t max_hierarchy_height = 64;

}  // namespace catena

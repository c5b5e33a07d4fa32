#pragma once
#include <cstdint>
#include <optional>

#include "catena/core/chain/chain.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/sphere.h"
#include "catena/reference/bound_tree.h"
#include "catena/reference/tree_shape.h"

namespace catena::reference {

/// True when every point of the child is in the parent: |cP - cC| + rC <= rP, in exact arithmetic, no
/// tolerance. An infinite parent radius encloses everything. NaN anywhere, a negative radius, or an infinite
/// number elsewhere is a violation. O(1); allocates only near a tie or where binary64 could overflow or
/// underflow.
bool encloses(const Sphere64& parent, const Sphere64& child);

/// The same from integers alone, without the binary64 estimate; what the estimate is tested against.
bool encloses_by_integers(const Sphere64& parent, const Sphere64& child);

/// True when no point is in both: |cA - cB| > rA + rB, in exact arithmetic. Touching is not separate, nor is
/// anything with NaN, an infinite number or a negative radius. Cost as for `encloses`.
bool separate(const Sphere64& a, const Sphere64& b);

/// The same from integers alone.
bool separate_by_integers(const Sphere64& a, const Sphere64& b);

/// How far the child sticks out, (|cP - cC| + rC - rP) / rP, to a relative 2^-50; negative or 0 when
/// enclosed, infinite when a number is not finite or rP = 0 does not enclose.
double shortfall(const Sphere64& parent, const Sphere64& child);

struct EnclosureReport {
  std::uint64_t bounds = 0;  ///< (parent, child) seen
  /// Those that do not enclose: the child's bound, where the tree promises that (the paper's), else some
  /// sphere below the child.
  std::uint64_t violations = 0;
  double worst_shortfall = 0;  ///< largest shortfall of a violation, relative to the parent's radius
  /// Leaves shown that are not the chain's sphere of their index: a tree over other spheres proves nothing.
  std::uint64_t foreign_leaves = 0;
  /// Nodes without one place and bound in the tree; only seen where spheres are held against their ancestors.
  std::uint64_t misplaced = 0;

  double share() const {
    return bounds == 0 ? 0 : static_cast<double>(violations) / static_cast<double>(bounds);
  }
};

/// Checks every bound that a variant shows of its last build, and gathers the shape of its tree. Ids are
/// below 8n.
class EnclosureChecker final : public BoundsVisitor {
 public:
  /// `chain` is that of the variant's last build and must outlive the checker.
  explicit EnclosureChecker(const Chain& chain) : chain_(chain), shape_(chain.size()) {}

  void tree(const TreeFacts& facts) override { facts_ = facts; }
  void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
            const AnyBound& child) override;

  EnclosureReport report();  ///< when all was shown
  const TreeFacts& facts() const noexcept { return facts_; }
  TreeShape shape() const { return shape_.shape(); }  ///< O(nodes log nodes)

 private:
  const Chain& chain_;
  EnclosureReport report_;
  TreeShapeBuilder shape_;
  TreeFacts facts_;
  std::optional<BoundTree> tree_;  ///< where spheres must be held against their ancestors
};

}  // namespace catena::reference

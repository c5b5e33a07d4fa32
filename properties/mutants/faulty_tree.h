#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/hierarchy/level.h"
#include "catena/core/strategy/variant.h"

namespace catena::properties {

/// A correct variant in steps that can be replaced: a mutant replaces one and has one bug. The tree is that
/// of aCPU2, the search that of CPU2, the arithmetic robust. Written to be broken, not to be fast; as it
/// stands it passes every property, which the mutants' test checks.
class FaultyTree : public Variant {
 public:
  using Base = FaultyTree;

  void build(const Chain& chain) override;
  void find(const Chain& chain, const Request& request, Collisions& result) override;
  Timings timings() const override { return {}; }
  void visit_bounds(BoundsVisitor& visitor) const override;

 protected:
  // Construction.
  virtual void construct();  ///< inner nodes of tree(), whose leaves are there, for n >= 1
  virtual Sphere parent(const Sphere& a, const Sphere& b) const;

  // Search.
  void start(const Chain& chain, const Request& request);  ///< empties counts() and pairs()
  virtual void search(const ChainView& chain,
                      std::uint32_t i);  ///< calls hit(i, j) for every j that collides
  virtual bool descend(const Sphere& query, const Sphere& node) const;
  virtual bool neighbours(const ChainView& chain, std::uint32_t i, std::uint32_t j) const;
  virtual bool collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const;

  // Answer.
  virtual void hit(std::uint32_t i, std::uint32_t j);  ///< every colliding pair comes twice, from both ends
  virtual void answer(const Request& request, Collisions& result);  ///< from counts() and pairs()

  /// Makes `slot` the parent of two nodes that are done.
  void join(std::uint32_t slot, const Links& children);

  HierarchyView<Sphere>& tree() { return tree_; }
  const HierarchyView<Sphere>& tree() const { return tree_; }
  std::vector<std::uint32_t>& counts() { return counts_; }
  std::vector<Pair>& pairs() { return pairs_; }
  /// Leaf j against sphere i: not itself, no neighbour, and they collide.
  void leaf(const ChainView& chain, std::uint32_t i, std::uint32_t j);

 private:
  void below(const ChainView& chain, std::uint32_t i, std::uint32_t slot);

  Hierarchy<Sphere> storage_;
  HierarchyView<Sphere> tree_{};
  std::vector<std::uint32_t> counts_;
  std::vector<Pair> pairs_;
  SphereRange queries_;
};

}  // namespace catena::properties

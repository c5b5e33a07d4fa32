#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/variant.h"
#include "catena/reference/answer.h"

namespace catena::properties {

/// One inner node as a variant shows it.
struct ParentSeen {
  Sphere64 parent;
  std::vector<std::uint32_t> ids;  ///< of the children: below n the sphere of that index
  std::vector<Sphere64> children;
};

/// The positive numbers of one format: of "literal" those of binary32, of "double" those of binary64.
struct Format {
  double least, least_normal, greatest;
};

/// What the paper's formulas make of one chain.
struct Observed {
  Format format;
  Chain chain;
  reference::Answer exact;
  std::vector<ParentSeen> parents;   ///< of aCPU2, by node id
  Collisions by_tree, by_all_pairs;  ///< of aCPU2+CPU2 and of CPU1, pairs sorted

  bool finds(const Collisions& found, const Pair& pair) const;
  bool all_nodes_finite() const;
};

/// True when no number of it is infinite or not a number.
bool is_finite(const Sphere64& sphere);

/// Runs one arithmetic ("literal", "double", "robust") on chains.
class Observer {
 public:
  explicit Observer(const std::string& arithmetic);
  Observed of(Chain chain);

 private:
  Format format_;
  std::unique_ptr<Variant> tree_, all_pairs_;
};

}  // namespace catena::properties

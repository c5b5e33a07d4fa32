#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena::properties {

/// A chain in the making: everything that Chain is made from, free to edit. Strands and rule are those of a
/// valid chain after every edit below, so that a chain stays a chain.
struct Draft {
  std::vector<Sphere> spheres;
  Strands strands;  ///< empty: one open strand
  Exclusion exclusion;

  static Draft of(const Chain& chain) {
    return {{chain.spheres().begin(), chain.spheres().end()}, chain.strands(), chain.exclusion()};
  }
  /// Throws InputError when a sphere is not finite or a radius negative.
  Chain chain() const& { return Chain(spheres, strands, exclusion); }
  Chain chain() && { return Chain(std::move(spheres), std::move(strands), std::move(exclusion)); }

  std::uint32_t size() const { return static_cast<std::uint32_t>(spheres.size()); }
  bool finite() const;  ///< every number finite, every radius >= 0

  /// Takes spheres first..first+count-1 out; strands left without spheres go too, extra pairs follow their
  /// spheres.
  void remove(std::uint32_t first, std::uint32_t count);
  /// Ends a strand before sphere `at` and begins one there; both are open.
  void cut(std::uint32_t at);
  /// Puts a copy of sphere `at` behind it, in the same strand.
  void repeat(std::uint32_t at);
};

}  // namespace catena::properties

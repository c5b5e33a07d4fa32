#pragma once
#include <cstdint>

#include "catena/core/policies/GPU2.h"

namespace catena::policy {

/// GPUv2 (Section 5.2; the paper also writes GPU2v2): two threads per sphere, thread 0 takes the subtree of
/// the root's left child, thread 1 the right one's. A sphere's collisions are the sum over its two threads.
template <class Arithmetic>
struct GPUv2 {
  static constexpr std::uint32_t threads_per_sphere = 2;

  template <class V>
  CATENA_HD static void visit(std::uint32_t i, std::uint32_t thread, const ChainView& chain,
                              const HierarchyView<typename Arithmetic::Bound>& tree, V& visitor) {
    GPU2<Arithmetic>::visit_half(i, thread, chain, tree, visitor);
  }
};

}  // namespace catena::policy

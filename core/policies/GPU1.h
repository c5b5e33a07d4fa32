#pragma once
#include <cstdint>

#include "catena/core/chain/chain_view.h"
#include "catena/core/host_device.h"

namespace catena::policy {

/// GPU1 (Section 3): one thread per sphere compares it with every other sphere. O(n) a sphere.
template <class Arithmetic>
struct GPU1 {
  template <class V>
  CATENA_HD static void visit(std::uint32_t i, const ChainView& chain, V& visitor) {
    const auto sphere = Arithmetic::bound(chain.spheres[i]);
    for (std::uint32_t j = 0; j < chain.size; ++j) {
      if (j == i) continue;
      visitor.tested_pair(j);
      if (Arithmetic::overlap(sphere, Arithmetic::bound(chain.spheres[j])) && !chain.neighbours(i, j)) visitor.hit(j);
    }
  }
};

}  // namespace catena::policy

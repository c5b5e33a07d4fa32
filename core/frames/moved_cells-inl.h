#pragma once
#include <algorithm>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/frames/moved_cells.h"

namespace catena {

template <class IsMoved>
void MovedCells::search(const ChainView& chain, const IsMoved& is_moved, std::vector<Pair>& pairs) const {
  for (std::uint32_t j = 0; j < chain.size; ++j) {
    const Sphere b = chain.spheres[j];
    const bool outside = (b.x < around_.low[0]) | (b.x > around_.high[0]) | (b.y < around_.low[1]) |
                         (b.y > around_.high[1]) | (b.z < around_.low[2]) | (b.z > around_.high[2]);
    if (outside) continue;
    const std::uint32_t cell = cell_of(along(0, b.x), along(1, b.y), along(2, b.z));
    for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) {
      const std::uint32_t i = entries_[k];
      if (Robust::separate(chain.spheres[i], b)) continue;
      // Two that moved are met from both: once is enough.
      if (i == j || (j < i && is_moved(j)) || chain.neighbours(std::min(i, j), std::max(i, j))) continue;
      if (Robust::overlap(chain.spheres[i], b)) pairs.push_back({std::min(i, j), std::max(i, j)});
    }
  }
}

}  // namespace catena

#pragma once
#include <cstdint>
#include <numeric>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {

/// The spheres of a strand as a line of a graphics format: a closed one ends where it starts. One sphere
/// alone is no line, but a point.
inline std::vector<std::uint32_t> strand_cell(const Chain& chain, std::uint32_t strand) {
  const std::uint32_t first = chain.strands().first[strand], last = chain.strands().first[strand + 1];
  std::vector<std::uint32_t> cell(last - first);
  std::iota(cell.begin(), cell.end(), first);
  if (chain.strands().closed[strand] && cell.size() > 1) cell.push_back(first);
  return cell;
}

}  // namespace catena

#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/chain/exclusion.h"

namespace catena {

/// How the spheres divide into strands (consecutive runs), each open or closed.
struct CATENA_API Strands {
  /// Strands + 1 ascending offsets, from 0 to n; empty means one open strand.
  std::vector<std::uint32_t> first;
  /// One flag a strand: the last sphere is joined to the first; empty: all open.
  std::vector<std::uint8_t> closed;

  static Strands one_closed(std::uint32_t n) { return {{0, n}, {1}}; }
};

/// Lengths along strands, from centre to centre.
struct CATENA_API ArcLengths {
  std::vector<double> arc;          ///< one a sphere: from its strand's first sphere
  std::vector<double> loop_length;  ///< one a strand: from its first sphere around to it
};

/// What all frames of a chain have in common: its strands and who are neighbours, indexed for look-up. Made
/// once, shared by every chain that was moved from it, and moved to a device once.
struct CATENA_API Topology {
  Strands strands;
  Exclusion exclusion;                   ///< extra pairs sorted, unique, i < j
  std::vector<std::uint32_t> strand_of;  ///< n entries; empty for one open strand
  /// Partners of each sphere, both directions, those of each ascending; empty without extra pairs.
  std::vector<std::uint32_t> extra_row, extra;
  std::vector<double> arc, loop_length;  ///< arc rule only: of the chain that it was made with
  std::uint64_t number = 0;              ///< no other topology of this program has it; never 0 once made
};

}  // namespace catena

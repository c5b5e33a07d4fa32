#pragma once
#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/scenes/animation.h"

namespace catena::ranks {

/// The number of a sphere in a chain that no rank holds whole.
using SphereId = std::uint64_t;

/// Two spheres by their numbers in the whole chain.
struct IdPair {
  SphereId i, j;
  friend auto operator<=>(const IdPair&, const IdPair&) = default;
};

/// Consecutive spheres of the whole chain: begin <= id < end. By default all of them.
struct IdRange {
  SphereId begin = 0, end = ~SphereId{0};
  bool contains(SphereId id) const { return begin <= id && id < end; }
  bool all() const { return *this == IdRange{}; }
  friend bool operator==(const IdRange&, const IdRange&) = default;
};

/// A strand of the whole chain. Its first sphere tells it from all others, as empty ones have no spheres.
struct Strand {
  SphereId first = 0;
  std::uint64_t size = 0;
  double loop_length = 0;    ///< of a closed one, under an arc window
  std::uint64_t closed = 0;  ///< 0 or 1; as wide as the others, so that no byte of it is undefined
  std::uint64_t number = 0;  ///< of all strands, from 0
};

/// Consecutive spheres of one strand that a rank holds.
struct Piece {
  SphereId first;             ///< of the whole chain
  std::uint32_t begin, size;  ///< where they are in the part
  Strand strand;
};

/// Who are neighbours; extra pairs apart.
struct Rule {
  Exclusion::Rule kind = Exclusion::Rule::index_window;
  std::uint32_t window = 1;
  double factor = 0;
};

/// The spheres of a chain that one rank holds, fewer than 2^31, with all that is needed to say who their
/// neighbours are. Not a parts::LocalChain, which is ranges of a chain that is here whole, with a halo, and
/// so leaves the spheres where they are and numbers them by 32 bits: here nothing else of the chain is known,
/// and the strands are told with it.
struct Part {
  Rule rule;
  std::vector<Sphere> spheres;
  std::vector<Piece> pieces;  ///< of the spheres, in their order
  std::vector<double> arcs;   ///< under an arc window: of each sphere, along its strand of the whole chain
  /// Extra neighbours of spheres of the part: (its own, the other one), sorted. Where both are of the part,
  /// both ways.
  std::vector<IdPair> extra;
};

/// The spheres first, ..., end - 1 of a chain as a part of it. O(their number + log n + strands and extra
/// pairs there).
Part part_of(const Chain& chain, std::uint32_t first, std::uint32_t end);

/// The same of a chain of which no more is made, under an index window without extra pairs.
Part part_of(const ChainByStretches& chain, std::uint32_t first, std::uint32_t end);

/// Where rank r of `ranks` begins when n spheres are shared out evenly; n for r = ranks.
inline SphereId even_start(SphereId n, unsigned ranks, unsigned rank) {
  return n / ranks * rank + std::min<SphereId>(rank, n % ranks);
}

/// What rank r of `ranks` gets then of a chain that is here whole. Cost as of part_of.
inline Part even_part_of(const Chain& chain, unsigned ranks, unsigned rank) {
  const auto start = [&](unsigned r) {
    return static_cast<std::uint32_t>(even_start(chain.size(), ranks, r));
  };
  return part_of(chain, start(rank), start(rank + 1));
}

}  // namespace catena::ranks

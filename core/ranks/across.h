#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/held_part.h"
#include "catena/core/ranks/local_search.h"

namespace catena::ranks {

/// Collisions of a sphere, by the number that it has in the whole chain, of which there may be more.
struct Counted {
  SphereId sphere;
  std::uint64_t collisions;
};

/// How a search across ranks goes about it; the answer is the same but for `stop_at_first`.
struct AcrossOptions {
  bool stop_at_first = false;  ///< one pair will do
  /// That a rank sends, and gets, in a round; 0: a quarter of its own, at least 2^16 and at most 2^26.
  std::uint32_t blocks_at_once = 0;
  /// Of its own, so many times those of both sides, that blocks which came are compared with one after the
  /// other; then those that are left are searched for together, which takes about as long.
  std::uint32_t meetings = 32;
};

/// What a search across ranks took of this one.
struct AcrossWork {
  std::uint64_t partners = 0;  ///< ranks that it asked
  std::uint64_t rounds = 0;
  std::uint64_t border = 0;           ///< its own blocks that touch the top of another rank
  std::uint64_t blocks_told = 0;      ///< blocks of others that it was told of, as they touch its top
  std::uint64_t blocks_asked = 0;     ///< whose capsules touch a sphere of its own
  std::uint64_t blocks_touching = 0;  ///< of these, those of which a sphere touches one of its own
};

/// Every pair that collides and whose spheres are held by two ranks, by one of the two. All tell the tops of
/// their trees. Of two ranks that may touch, each asks the other, so that both compare about half: the lower
/// one about every other stripe of those blocks of the higher one that touch its top, the higher one on
/// behalf of the other stripes. In rounds: it is told of the other's blocks that touch its top (ToldBlock),
/// asks for those whose capsules touch a sphere of its own, and compares their spheres. A round brings no
/// rank more, and takes none from it, than `blocks_at_once`. Adds to `counted`, for spheres of the part and
/// of others, and to `kept`.
AcrossWork search_across(Communicator& ranks, const HeldPart& part, const AcrossOptions& options,
                         std::vector<Counted>& counted, KeptPairs& kept);

}  // namespace catena::ranks

#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/export.h"
#include "catena/core/pair.h"

namespace catena {

/// Where in an answer those of a list's pairs stand that collide, so that one which begins to or ceases is
/// put in or taken out alone.
class CATENA_API StandingPairs {
 public:
  /// None of so many stands.
  void clear(std::size_t listed);

  /// Each of these pairs of the list, none twice, goes from the answer where it stands and comes where it
  /// does not; spheres[place] is the sphere at a place of the list. O(changed), one after the other.
  void exchange(std::span<const std::uint32_t> changed, std::span<const Pair> list,
                std::span<const std::uint32_t> spheres, std::vector<Pair>& pairs,
                std::vector<std::uint32_t>& counts);

 private:
  static constexpr std::uint32_t nowhere = 0xFFFFFFFF;

  LargeVector<std::uint32_t> at_;   ///< of each pair of the list, its place in the answer or nowhere
  LargeVector<std::uint32_t> who_;  ///< of each place in the answer, the pair of the list
  LargeVector<std::uint32_t> come_, go_;
};

}  // namespace catena

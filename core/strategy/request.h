#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/host_device.h"
#include "catena/core/pair.h"

namespace catena {

/// Consecutive spheres of a chain: begin <= i < end. By default all of them.
struct CATENA_API SphereRange {
  std::uint32_t begin = 0, end = 0xFFFFFFFFu;

  CATENA_HD bool contains(std::uint32_t i) const { return begin <= i && i < end; }
  /// The part of it in a chain of n spheres; begin <= end <= n.
  SphereRange within(std::uint32_t n) const {
    return {std::min(begin, n), std::max(std::min(begin, n), std::min(end, n))};
  }
  CATENA_HD std::uint32_t size() const { return end - begin; }
  friend bool operator==(const SphereRange&, const SphereRange&) = default;
};

/// What the caller wants to know. Asking for less lets a strategy leave work out.
struct CATENA_API Request {
  enum class Want {
    any,     ///< only whether anything collides: the search may stop at the first pair
    counts,  ///< collisions of each sphere (the paper's output array)
    pairs    ///< counts and the pairs
  };
  Want want = Want::pairs;
  /// More pairs than this is an error with the true number, never a silent loss. The default is 1 GiB of
  /// pairs.
  std::uint64_t pair_limit = std::uint64_t{1} << 27;
  /// Searched for: the counts of these spheres, each against the whole chain, and the pairs i < j whose i is
  /// one of them. So searches whose ranges part the chain, on other devices or ranks, give every count and
  /// every pair once.
  SphereRange queries = {};
  /// Frames of the same chain will follow, by update: a build may keep what they can do without.
  bool frames_follow = false;
};

/// The answer. Reused from call to call, so that its memory is too.
struct CATENA_API Collisions {
  bool found = false;                ///< at least one pair; the only member that Want::any fills
  std::uint64_t pair_count = 0;      ///< colliding pairs, each counted once
  std::vector<std::uint32_t> count;  ///< n entries: collisions of each sphere; 0 outside of Request::queries
  std::vector<Pair> pairs;           ///< i < j, each once, in no particular order
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/strategy/request.h"

namespace catena::parts {

/// Which spheres of a chain a part has: its own, ascending, and its halo, those of parts before it and those
/// of parts after it, each ascending. The halo has every sphere of another part that may touch one of its
/// own.
struct PartRanges {
  std::vector<SphereRange> before, own, after;
};

/// Appends a range that begins where another ends as one with it.
inline void append(std::vector<SphereRange>& ranges, SphereRange range) {
  if (!ranges.empty() && ranges.back().end == range.begin)
    ranges.back().end = range.end;
  else
    ranges.push_back(range);
}

/// How many spheres the ranges have together.
inline std::uint64_t spheres_in(const std::vector<SphereRange>& ranges) {
  std::uint64_t spheres = 0;
  for (const SphereRange& range : ranges) spheres += range.size();
  return spheres;
}

}  // namespace catena::parts

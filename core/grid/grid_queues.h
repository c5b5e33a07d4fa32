#pragma once
#include <array>
#include <cstdint>

#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// Spheres to be compared, field by field. Past `room` candidates the list is not filled; what is read or
/// written in vectors may pass it.
struct CandidateFields {
  /// Not a multiple of 1,024, for the fields must not lie on the same lines of the cache.
  static constexpr std::uint32_t room = 2048, size = room + 48;
  alignas(64) float x[size], y[size], z[size], radius[size];  ///< side by side: `size` numbers from x to y
  alignas(64) std::uint32_t index[size];
  static_assert(size * sizeof(float) % 64 == 0, "a field begins where the one before it ends");
};

/// What a search of a SphereGrid works on: candidates side by side, which stay in the first cache; a flat
/// list of tests of a sphere against a vector of them; and the pairs that a test leaves. Flat lists instead
/// of nested loops, whose ends are hard to foretell.
struct GridQueues {
  static constexpr std::uint32_t most_lanes = 16;
  /// Past so many tests the list is worked off; so many may be added at once.
  static constexpr std::uint32_t test_limit = 256, test_room = 4096;
  static constexpr std::uint32_t hit_limit = 1024;
  static constexpr std::uint32_t group_room = 1024;

  struct Test {
    std::uint32_t place;      ///< of the sphere
    std::uint32_t candidate;  ///< the first of a vector of candidates
  };

  /// Places of spheres, and of candidates for each in a row of cells, from one to the one before another; a
  /// vector that is stored may pass the last.
  struct Rows {
    static constexpr std::uint32_t spheres = 64, most_of_one = 5 * 3,
                                   room = most_of_one * spheres + most_lanes;
    std::uint32_t size = 0;
    std::array<std::uint32_t, room> place, from, until;
  };
  /// Places of two spheres that are to be compared, likewise past the limit.
  struct Pairs {
    static constexpr std::uint32_t limit = 512;
    std::array<std::uint32_t, limit + 2 * most_lanes> a, b;
  };

  GridQueues() {}  // not by default, which would set all of it to 0 in a vector of them

  std::uint64_t tests_done = 0;  ///< since this was made
  std::uint64_t open_done = 0;   ///< pairs that binary32 left open, likewise
  CandidateFields candidates;
  Rows reached{}, rows{};
  Pairs pairs{};  // as rows: a vector that is read may pass the last, too
  LargeVector<Test> tests = LargeVector<Test>(test_limit + test_room);
  LargeVector<Pair> hits = LargeVector<Pair>(hit_limit + most_lanes);
  LargeVector<std::uint32_t> groups =
      LargeVector<std::uint32_t>(group_room + 1);  ///< buckets where one begins
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <vector>

namespace catena {

/// What a search of a SphereGrid works on: candidates side by side, which stay in the first cache; a flat list of tests
/// of a sphere against a vector of them; and the pairs that a test leaves. Flat lists instead of nested loops, whose ends
/// are hard to foretell.
struct GridQueues {
  static constexpr std::uint32_t most_lanes = 16;
  /// Candidates; not a multiple of 1,024, for the fields must not lie on the same lines of the cache.
  static constexpr std::uint32_t room = 2048 + 48;
  /// Past so many tests the list is worked off; `test_room` is what one group of buckets may add.
  static constexpr std::uint32_t test_limit = 128, test_room = 4096;
  static constexpr std::uint32_t hit_limit = 1024;

  struct Test {
    std::uint32_t place;      ///< of the sphere
    std::uint32_t candidate;  ///< the first of a vector of candidates
  };

  std::vector<float> x = std::vector<float>(room + most_lanes), y = x, z = x, radius = x;
  std::vector<std::uint32_t> index = std::vector<std::uint32_t>(room + most_lanes);
  std::vector<Test> tests = std::vector<Test>(test_limit + test_room);
  std::vector<std::uint32_t> hit_i = std::vector<std::uint32_t>(hit_limit + most_lanes), hit_j = hit_i;
  std::vector<std::uint32_t> groups;  ///< buckets at which a group begins that has spheres
};

}  // namespace catena

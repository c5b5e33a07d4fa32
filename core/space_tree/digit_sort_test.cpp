#include "catena/core/space_tree/digit_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace catena {
namespace {

/// Keys in their upper halves of which these bits differ; numbers that say nothing of the order in their
/// lower ones.
std::vector<std::uint64_t> keys_of(std::size_t n, std::uint32_t bits, std::uint32_t same) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(n));
  std::vector<std::uint64_t> keys(n);
  for (std::uint64_t& key : keys) key = std::uint64_t{(random() & bits) | (same & ~bits)} << 32 | random();
  return keys;
}

TEST(DigitSort, IsStableByTheUpperHalfWhateverBitsDiffer) {
  for (const std::size_t n : {0u, 1u, 2u, 3u, 255u, 1024u, 4097u})
    for (const std::uint32_t bits :
         {0u, 1u, 0x80000000u, 0x80000001u, 0x1FFu, 0x3FE00u, 0x7FFFFFFu, 0x18000u, ~0u})
      for (const std::uint32_t same : {0u, ~0u}) {
        std::vector<std::uint64_t> keys = keys_of(n, bits, same), room(n), expected = keys;
        std::ranges::stable_sort(expected, {}, [](std::uint64_t key) { return key >> 32; });
        const std::span<std::uint64_t> sorted = sort_by_digits(keys, room);
        EXPECT_TRUE(sorted.data() == keys.data() || sorted.data() == room.data());
        EXPECT_TRUE(std::ranges::equal(sorted, expected)) << n << " keys, bits " << bits << " of " << same;
      }
}

}  // namespace
}  // namespace catena

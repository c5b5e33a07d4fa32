#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "catena/core/compiled_for.h"

namespace catena {

/// Sorts numbers, fewer than 2^32, by their upper 32 bits, by digits of nine bits and the lowest first (LSD
/// radix sort); those that are alike there keep their order. `room` is as long as `keys`; either is written,
/// and the one that is returned holds the result. O(n): two passes that look, and one for each nine of the
/// bits between those that are not the same in all.
///
/// Keys are taken from both ends at once, as those that follow one another are often of one digit: each would
/// wait for the count that the one before has just changed.
inline std::span<std::uint64_t> sort_by_digits(std::span<std::uint64_t> keys, std::span<std::uint64_t> room) {
  constexpr int bits = 9, most_digits = 4;
  constexpr std::size_t bins = std::size_t{1} << bits;
  std::uint64_t any = 0, all = ~std::uint64_t{0};
  for (const std::uint64_t key : keys) any |= key, all &= key;
  const auto differing = static_cast<std::uint32_t>((any & ~all) >> 32);
  if (differing == 0) return keys;
  const int lowest = 32 + std::countr_zero(differing),
            width = static_cast<int>(std::bit_width(any & ~all)) - lowest;
  const auto digit = [&](std::uint64_t key, int d) {
    return static_cast<std::size_t>(key >> (lowest + d * bits)) & (bins - 1);
  };
  // Counts, then places: of those taken from the front, and of those taken from the back.
  std::uint32_t front[most_digits][bins] = {}, back[most_digits][bins] = {};
  const auto from_both_ends = [&](const auto& first, const auto& last) {
    const std::size_t half = keys.size() / 2;
    for (std::size_t k = 0; k < half; ++k) first(keys[k]), last(keys[keys.size() - 1 - k]);
    if (keys.size() % 2 == 1) first(keys[half]);
  };
  const int digits = (width + bits - 1) / bits;
  const auto count = [&](auto& counts) {
    return [&](std::uint64_t key) {
      for (int d = 0; d < digits; ++d) ++counts[d][digit(key, d)];
    };
  };
  from_both_ends(count(front), count(back));
  for (int d = 0; d < digits; ++d) {
    std::uint32_t before = 0;
    for (std::size_t b = 0; b < bins; ++b) {
      const std::uint32_t there = front[d][b] + back[d][b];
      front[d][b] = std::exchange(before, before + there), back[d][b] = before;
    }
    from_both_ends([&](std::uint64_t key) { room[front[d][digit(key, d)]++] = key; },
                   [&](std::uint64_t key) { room[--back[d][digit(key, d)]] = key; });
    std::swap(keys, room);
  }
  return keys;
}

}  // namespace catena

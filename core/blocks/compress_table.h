#pragma once
#include <array>
#include <cstdint>

namespace catena {

/// Row m: the places of the bits of m, then zeros.
inline constexpr auto compress_table = [] {
  std::array<std::array<std::uint8_t, 8>, 256> rows{};
  for (std::uint32_t m = 0; m < 256; ++m)
    for (std::uint8_t bit = 0, size = 0; bit < 8; ++bit)
      if (m >> bit & 1) rows[m][size++] = bit;
  return rows;
}();

}  // namespace catena

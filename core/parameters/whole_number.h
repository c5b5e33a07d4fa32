#pragma once
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace catena {

/// A whole number from 0: digits below 2^64, or up to 2^53 as in 1e6 and 2.5e5. Nothing when the text is
/// none.
inline std::optional<std::uint64_t> whole_number(std::string_view text) {
  const char *begin = text.data(), *end = begin + text.size();
  std::uint64_t digits = 0;
  if (const auto read = std::from_chars(begin, end, digits); read.ec == std::errc{} && read.ptr == end)
    return digits;
  double real = 0;
  const auto read = std::from_chars(begin, end, real);
  if (read.ec != std::errc{} || read.ptr != end || !(real >= 0 && real <= 0x1p53) || real != std::floor(real))
    return std::nullopt;
  return static_cast<std::uint64_t>(real);
}

}  // namespace catena

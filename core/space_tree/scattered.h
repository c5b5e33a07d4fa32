#pragma once
#include <cstdint>

namespace catena {

/// The k-th of numbers below `end` that lie evenly, whatever part of them is taken, and have no period: parts
/// of the golden section.
constexpr std::uint32_t scattered(std::uint32_t k, std::uint32_t end) {
  return static_cast<std::uint32_t>(std::uint64_t{k * 0x9E3779B1u} * end >> 32);
}

}  // namespace catena

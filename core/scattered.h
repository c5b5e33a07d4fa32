#pragma once
#include <cstdint>

#include "catena/core/host_device.h"

namespace catena {

/// The k-th of numbers below `end` that lie evenly, whatever part of them is taken, and have no period: parts
/// of the golden section.
CATENA_HD constexpr std::uint32_t scattered(std::uint32_t k, std::uint32_t end) {
  return static_cast<std::uint32_t>(std::uint64_t{k * 0x9E3779B1u} * end >> 32);
}

/// The k-th of so many samples all along 0 .. end, k < samples: scattered in an even part each, all
/// different where samples <= end. None is the first for being that, as the end of a chain is like no other.
constexpr std::uint32_t sample_along(std::uint32_t k, std::uint32_t samples, std::uint32_t end) {
  const auto begin = [&](std::uint64_t j) { return static_cast<std::uint32_t>(j * end / samples); };
  return begin(k) + scattered(k + 1, begin(k + 1) - begin(k));
}

}  // namespace catena

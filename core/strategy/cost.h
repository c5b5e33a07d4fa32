#pragma once
#include <cstdint>

#include "catena/core/export.h"

namespace catena {

/// About what build and find of a variant take together on a chain of n spheres with few collisions. Chooses
/// between variants that give the same answer, and decides nothing else.
struct CATENA_API Cost {
  double fixed_us = 0;        ///< whatever n is; of a device with its latency
  double sphere_ns = 0;       ///< for each sphere; of a device with its transfers
  double sphere_pair_ns = 0;  ///< for each of n (n - 1) / 2 pairs, of what compares all of them
  double start_ms = 0;        ///< once in a process, besides: of a device, to start it

  double ms(std::uint32_t n) const {
    return fixed_us * 1e-3 + (sphere_ns + sphere_pair_ns * 0.5 * (n > 0 ? n - 1.0 : 0.0)) * n * 1e-6;
  }
  friend bool operator==(const Cost&, const Cost&) = default;
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <cstring>

#include "catena/core/host_device.h"

namespace catena {

/// Spheres by their radius: octave k holds radii in (R 2^-(k+1), R 2^-k], R the greatest of the chain. There
/// are fewer than 280 between the greatest binary32 number and the least; points are the last.
struct Octaves {
  static constexpr std::uint32_t count = 288;
  double greatest;
  bool one;    ///< all radii are in octave 0
  bool equal;  ///< they are all the same

  CATENA_HD std::uint32_t of(float radius) const {
    if (one) return 0;
    if (radius == 0) return count - 1;
    // In binary64 all binary32 numbers are normal: the exponents' difference, one less where that is too
    // small a bound.
    const std::uint64_t r = bits(radius), most = bits(greatest), fraction = (std::uint64_t{1} << 52) - 1;
    const auto halvings = static_cast<std::uint32_t>((most >> 52) - (r >> 52));
    return halvings - ((r & fraction) > (most & fraction) ? 1 : 0);
  }

  /// Cells of octave k are as wide as two of its greatest spheres: this many times as many as of octave 0.
  CATENA_HD static double cells_of(std::uint32_t octave) {
    const std::uint64_t power_of_two = std::uint64_t{1023 + octave} << 52;
    double result;
    std::memcpy(&result, &power_of_two, sizeof result);
    return result;
  }

 private:
  CATENA_HD static std::uint64_t bits(double v) {
    std::uint64_t result;
    std::memcpy(&result, &v, sizeof result);
    return result;
  }
};

}  // namespace catena

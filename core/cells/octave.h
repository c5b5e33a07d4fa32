#pragma once
#include <cstdint>
#include <cstring>

#include "catena/core/host_device.h"

namespace catena {

/// Spheres by their radius: octave k holds radii in (R 2^-(k+1), R 2^-k], R the greatest of the chain; the last all
/// smaller ones.
struct Octaves {
  static constexpr std::uint32_t count = 32;
  double greatest;
  bool one;  ///< all radii are in octave 0

  CATENA_HD std::uint32_t of(float radius) const {
    if (one) return 0;
    if (radius == 0) return count - 1;
    // In binary64 all binary32 numbers are normal: the exponents' difference, one less where that is too small a bound.
    const std::uint64_t r = bits(radius), most = bits(greatest), fraction = (std::uint64_t{1} << 52) - 1;
    const auto halvings = static_cast<std::uint32_t>((most >> 52) - (r >> 52));
    const std::uint32_t octave = halvings - ((r & fraction) > (most & fraction) ? 1 : 0);
    return octave < count ? octave : count - 1;
  }

  /// Cells of octave k are as wide as two of its greatest spheres: this many times as many as of octave 0.
  CATENA_HD static double cells_of(std::uint32_t octave) { return static_cast<double>(std::uint32_t{1} << octave); }

 private:
  CATENA_HD static std::uint64_t bits(double v) {
    std::uint64_t result;
    std::memcpy(&result, &v, sizeof result);
    return result;
  }
};

}  // namespace catena

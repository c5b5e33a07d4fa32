#pragma once
#include <type_traits>

#include "catena/core/export.h"

namespace catena {

/// One sphere of a chain: centre and radius as IEEE-754 binary32, 16 bytes, the layout of CUDA's float4.
/// The unit of length is the user's; catena never scales.
struct CATENA_API alignas(16) Sphere {
  float x, y, z, radius;
  friend bool operator==(const Sphere&, const Sphere&) = default;
};
static_assert(sizeof(Sphere) == 16 && std::is_trivially_copyable_v<Sphere>);

/// A sphere in binary64; every Sphere converts to it without rounding.
struct CATENA_API alignas(32) Sphere64 {
  double x, y, z, radius;
  friend bool operator==(const Sphere64&, const Sphere64&) = default;
};
static_assert(sizeof(Sphere64) == 32 && std::is_trivially_copyable_v<Sphere64>);

}  // namespace catena

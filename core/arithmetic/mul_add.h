#pragma once
#include <cmath>

#include "catena/core/host_device.h"

namespace catena {

/// a b + c, rounded once on a device and twice on the host: only where a proof is of both.
CATENA_HD inline float mul_add(float a, float b, float c) {
#ifdef __CUDA_ARCH__
  return fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

}  // namespace catena

#pragma once
#include <cstdint>

#include "catena/core/host_device.h"

namespace catena::cuda {

/// The calling thread block as the Group of a construction policy; the host's twin is HostGroup.
struct DeviceGroup {
  template <class Body>
  CATENA_HD void parallel(std::uint32_t count, const Body& body) {
#ifdef __CUDA_ARCH__
    for (std::uint32_t k = threadIdx.x; k < count; k += blockDim.x) body(k);
#endif
  }
  CATENA_HD void barrier() {
#ifdef __CUDA_ARCH__
    __syncthreads();
#endif
  }
};

}  // namespace catena::cuda

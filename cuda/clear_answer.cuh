#pragma once
#include <cuda_runtime.h>

#include <algorithm>

#include "catena/core/strategy/resident.h"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

template <class Answer>
__global__ void __launch_bounds__(256) clear_counts(const __grid_constant__ Answer answer, std::uint32_t n) {
  await_previous();
  if (blockIdx.x == 0 && threadIdx.x == 0) *answer.state = {};
  if (answer.count == nullptr) return;
  for (std::uint64_t i = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; i < n;
       i += std::uint64_t{gridDim.x} * blockDim.x)
    answer.count[i] = 0;
}

/// Sets counts and state of a resident answer for n spheres to nothing found; enqueued.
inline void clear_answer(const ResidentAnswer& answer, std::uint32_t n, cudaStream_t stream) {
  launch_next<clear_counts<ResidentAnswer>>(std::clamp((n + 1023) / 1024, 1u, 2112u), 256, stream, answer, n);
}

}  // namespace catena::cuda

#pragma once
#include <cuda_runtime.h>

#include <algorithm>

#include "catena/core/strategy/resident.h"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

template <class Answer>
__global__ void __launch_bounds__(512) clear_counts(const __grid_constant__ Answer answer, std::uint32_t n) {
  await_previous();
  if (blockIdx.x == 0 && threadIdx.x == 0) *answer.state = {};
  if (answer.count == nullptr) return;
  const std::uint64_t thread = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x,
                      threads = std::uint64_t{gridDim.x} * blockDim.x;
  const bool aligned =
      reinterpret_cast<std::uintptr_t>(answer.count) % sizeof(uint4) == 0;  // the caller's memory
  const std::uint32_t fours = aligned ? n / 4 : 0;
  for (std::uint64_t k = thread; k < fours; k += threads)
    reinterpret_cast<uint4*>(answer.count)[k] = {0, 0, 0, 0};
  for (std::uint64_t i = std::uint64_t{fours} * 4 + thread; i < n; i += threads) answer.count[i] = 0;
}

/// Sets counts and state of a resident answer for n spheres to nothing found; enqueued.
inline void clear_answer(const ResidentAnswer& answer, std::uint32_t n, cudaStream_t stream) {
  launch_next<clear_counts<ResidentAnswer>>(std::clamp((n + 4095) / 4096, 1u, 1056u), 512, stream, answer, n);
}

}  // namespace catena::cuda

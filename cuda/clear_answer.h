#pragma once
#include <cuda_runtime.h>

#include "catena/core/strategy/resident.h"
#include "catena/cuda/call.h"

namespace catena::cuda {

/// Sets counts and state of a resident answer for n spheres to nothing found; enqueued.
inline void clear_answer(const ResidentAnswer& answer, std::uint32_t n, cudaStream_t stream) {
  CATENA_CUDA(cudaMemsetAsync(answer.state, 0, sizeof *answer.state, stream));
  if (answer.count != nullptr && n > 0)
    CATENA_CUDA(cudaMemsetAsync(answer.count, 0, n * sizeof *answer.count, stream));
}

}  // namespace catena::cuda

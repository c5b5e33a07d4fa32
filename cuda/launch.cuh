#pragma once
#include <cuda_runtime.h>

#include <cstdint>

#include "catena/cuda/call.h"

namespace catena::cuda {

/// One thread for each of `items`, in blocks of `threads`; nothing is launched for none.
template <class... Parameters, class... Arguments>
void launch(void (*kernel)(Parameters...), std::uint64_t items, unsigned threads, cudaStream_t stream,
            const Arguments&... arguments) {
  if (items == 0) return;
  kernel<<<static_cast<unsigned>((items + threads - 1) / threads), threads, 0, stream>>>(arguments...);
  CATENA_CUDA(cudaGetLastError());
}

}  // namespace catena::cuda

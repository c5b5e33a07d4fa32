#pragma once
#include <cuda_runtime.h>

#include <cstdint>

#include "catena/cuda/call.h"

namespace catena::cuda {

/// A grid of `blocks` blocks of `threads` threads; nothing is launched for none.
template <class... Parameters, class... Arguments>
void launch_blocks(void (*kernel)(Parameters...), unsigned blocks, unsigned threads, cudaStream_t stream,
                   const Arguments&... arguments) {
  if (blocks == 0) return;
  kernel<<<blocks, threads, 0, stream>>>(arguments...);
  CATENA_CUDA(cudaGetLastError());
}

/// One thread for each of `items`, in blocks of `threads`.
template <class... Parameters, class... Arguments>
void launch(void (*kernel)(Parameters...), std::uint64_t items, unsigned threads, cudaStream_t stream,
            const Arguments&... arguments) {
  launch_blocks(kernel, static_cast<unsigned>((items + threads - 1) / threads), threads, stream,
                arguments...);
}

}  // namespace catena::cuda

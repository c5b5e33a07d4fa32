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

/// At the begin of a kernel that launch_next() starts: what comes before it in the stream is done, and its
/// memory seen. The next kernel's blocks may take their places from here on; they wait in the same way, so
/// that an order of kernels is kept as it is.
__device__ inline void await_previous() {
#if __CUDA_ARCH__ >= 900
  cudaTriggerProgrammaticLaunchCompletion();
  cudaGridDependencySynchronize();
#endif
}

/// Of a kernel on the current device, asked once for each device that a thread comes to from another one: its
/// code may be of another architecture there.
template <auto kernel>
const cudaFuncAttributes& attributes_here() {
  thread_local int known = -1;
  thread_local cudaFuncAttributes attributes{};
  int device = 0;
  CATENA_CUDA(cudaGetDevice(&device));
  if (device != known) {
    CATENA_CUDA(cudaFuncGetAttributes(&attributes, kernel));
    known = device;
  }
  return attributes;
}

/// Like launch_blocks, of a kernel that begins with await_previous() and comes next after another kernel: its
/// start overlaps that one's end, where the code is of an architecture that can wait.
/// Each block has `shared` bytes of memory of a size that is known only here.
template <auto kernel, class... Arguments>
void launch_next_sharing(unsigned blocks, unsigned threads, std::size_t shared, cudaStream_t stream,
                         const Arguments&... arguments) {
  if (blocks == 0) return;
  const cudaFuncAttributes& attributes = attributes_here<kernel>();
  constexpr std::size_t without_asking = 32 << 10;  // with what a kernel has of a fixed size, at most 48 KiB
  if (shared > without_asking) {  // for all that there is: another thread may launch it with more at this moment
    int device = 0, most = 0;
    CATENA_CUDA(cudaGetDevice(&device));
    CATENA_CUDA(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device));
    CATENA_CUDA(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                     most - static_cast<int>(attributes.sharedSizeBytes)));
  }
  cudaLaunchAttribute overlap{};
  overlap.id = cudaLaunchAttributeProgrammaticStreamSerialization;
  overlap.val.programmaticStreamSerializationAllowed = 1;
  cudaLaunchConfig_t config{};
  config.gridDim = blocks;
  config.blockDim = threads;
  config.dynamicSmemBytes = shared;
  config.stream = stream;
  config.attrs = &overlap;
  config.numAttrs = attributes.ptxVersion >= 90 ? 1 : 0;
  CATENA_CUDA(cudaLaunchKernelEx(&config, kernel, arguments...));
}
template <auto kernel, class... Arguments>
void launch_next(unsigned blocks, unsigned threads, cudaStream_t stream, const Arguments&... arguments) {
  launch_next_sharing<kernel>(blocks, threads, 0, stream, arguments...);
}

}  // namespace catena::cuda

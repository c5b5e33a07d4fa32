#include <cuda_runtime.h>

#include "catena/cuda/call.h"
#include "catena/cuda/device.h"

namespace catena::cuda {
namespace {

__global__ void probe() {}

std::optional<std::string> probe_device() {
  int devices = 0;
  cudaError_t code = cudaGetDeviceCount(&devices);
  if (code == cudaSuccess && devices == 0) code = cudaErrorNoDevice;
  if (code == cudaSuccess) {
    probe<<<1, 1>>>();  // fails when the program holds no code for this device
    code = cudaGetLastError();
    if (code == cudaSuccess) code = cudaDeviceSynchronize();
  }
  if (code == cudaSuccess) return std::nullopt;
  cudaGetLastError();
  return std::string("no usable CUDA device: ") + cudaGetErrorString(code);
}

}  // namespace

std::optional<std::string> unavailable() {
  static const std::optional<std::string> reason = probe_device();
  return reason;
}

unsigned max_block_threads() {
  int threads = 0;
  CATENA_CUDA(cudaDeviceGetAttribute(&threads, cudaDevAttrMaxThreadsPerBlock, 0));
  return static_cast<unsigned>(threads);
}

}  // namespace catena::cuda

#include <cuda_runtime.h>

#include <atomic>

#include "catena/core/never_destroyed.h"
#include "catena/cuda/call.h"
#include "catena/cuda/device.h"

namespace catena::cuda {
namespace {

__global__ void probe() {}

std::atomic<bool> probed = false;

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
  int driver = 0;  // without one CUDA speaks of its version
  if (code == cudaErrorNoDevice || (cudaDriverGetVersion(&driver) == cudaSuccess && driver == 0))
    return std::string("no device: this machine has no NVIDIA GPU, or no driver for it");
  return std::string("no usable CUDA device: ") + cudaGetErrorString(code);
}

}  // namespace

std::optional<std::string> unavailable() {
  static const auto& reason = never_destroyed(probe_device());
  probed = true;
  return reason;
}

bool started() { return probed; }

void require_device(Place place) {
  int devices = 0;
  CATENA_CUDA(cudaGetDeviceCount(&devices));
  if (place.index >= static_cast<unsigned>(devices))
    throw CapacityError("there is no CUDA device " + std::to_string(place.index) + "; this machine has " +
                        std::to_string(devices) + ", counted from 0");
}

unsigned most_block_threads(const void* kernel) {
  cudaFuncAttributes attributes{};
  CATENA_CUDA(cudaFuncGetAttributes(&attributes, kernel));
  return static_cast<unsigned>(attributes.maxThreadsPerBlock);
}

DeviceScope::DeviceScope(Place place) {
  CATENA_CUDA(cudaGetDevice(&before_));
  if (before_ != static_cast<int>(place.index)) CATENA_CUDA(cudaSetDevice(static_cast<int>(place.index)));
}

DeviceScope::~DeviceScope() { cudaSetDevice(before_); }

}  // namespace catena::cuda

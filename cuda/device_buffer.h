#pragma once
#include <cuda_runtime.h>

#include <cstddef>
#include <string>
#include <type_traits>

#include "catena/core/error.h"
#include "catena/cuda/call.h"

namespace catena::cuda {

/// Device memory that grows and never shrinks by itself, so that a second build of the same size does not
/// allocate. Allocation is ordered with the stream it is given; the end of the buffer waits for all of its
/// users, as by then their stream may be gone.
template <class T>
class DeviceBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  DeviceBuffer() = default;
  ~DeviceBuffer() {
    if (data_ == nullptr) return;
    int current = 0;
    cudaGetDevice(&current);
    cudaSetDevice(device_);
    // To free memory of a pool waits for nobody, and where a later buffer found no room work is under way.
    cudaDeviceSynchronize();
    cudaFree(data_);
    cudaSetDevice(current);
  }
  DeviceBuffer(const DeviceBuffer&) = delete;
  DeviceBuffer& operator=(const DeviceBuffer&) = delete;

  /// Room for n elements; the contents are lost when it grows. Throws CapacityError, naming need and supply,
  /// when the device has not that much memory.
  T* reserve(std::size_t n, cudaStream_t stream) {
    if (try_reserve(n, stream)) return data_;
    std::size_t free = 0, total = 0;
    CATENA_CUDA(cudaMemGetInfo(&free, &total));
    const auto mib = [](std::size_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; };
    throw CapacityError("out of device memory: " + mib(n * sizeof(T)) + " are needed, " + mib(free) + " of " +
                        mib(total) + " are free; the variant DeviceParts takes a chain part after part");
  }
  /// The same for what can be done without: false where there is no room.
  bool try_reserve(std::size_t n, cudaStream_t stream) {
    if (n <= capacity_) return true;
    release(stream);
    CATENA_CUDA(cudaGetDevice(&device_));
    const cudaError_t code = cudaMallocAsync(&data_, n * sizeof(T), stream);
    if (code == cudaErrorMemoryAllocation) {
      cudaGetLastError();
      data_ = nullptr;
      return false;
    }
    check(code, "cudaMallocAsync", __FILE__, __LINE__);
    capacity_ = n;
    return true;
  }

  /// Gives the memory back, once the stream comes to it.
  void release(cudaStream_t stream) {
    if (data_ != nullptr) CATENA_CUDA(cudaFreeAsync(data_, stream));
    data_ = nullptr;
    capacity_ = 0;
  }

  T* data() const { return data_; }
  std::size_t capacity() const { return capacity_; }

 private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
  int device_ = 0;
};

}  // namespace catena::cuda

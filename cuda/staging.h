#pragma once
#include <cuda_runtime.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "catena/core/executor/team.h"
#include "catena/core/strategy/request.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {

/// Moves arrays between a program's memory, which is pageable, and a device. Large ones go through pinned
/// chunks: while the device moves one, cores of the host copy the next; the driver alone takes one core and
/// is 2 to 5 times slower. To pin them takes as long as the driver needs for some 100 MB, so it moves that
/// much first, and everything where the system has no memory to pin.
class Staging {
 public:
  static constexpr std::size_t chunk = std::size_t{4} << 20;  ///< bytes
  static constexpr unsigned chunks = 4;

  Staging();
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// On its way in the stream when this returns; the program's memory is its own again.
  void to_device(void* device, const void* host, std::size_t bytes, cudaStream_t stream);
  /// Elements of an array that are being moved: from which on, how many, and where they can be read. Any core
  /// calls it.
  using Seen = std::function<void(std::size_t first, std::size_t count, const void* elements)>;
  /// The same of ranges of an array of elements of that many bytes, which come one after the other. `seen`,
  /// if any, is told of all, `together` at a time from the beginning of each range, or a multiple of so many.
  void to_device(void* device, const void* host, std::size_t element, std::span<const SphereRange> ranges,
                 cudaStream_t stream, const Seen& seen = {}, std::size_t together = 1);
  /// All of it is there when this returns.
  void to_host(void* host, const void* device, std::size_t bytes, cudaStream_t stream);

  /// to_device of n elements into a buffer that grows when needed; returns the device's address.
  template <class T>
  T* upload(DeviceBuffer<T>& buffer, const T* host, std::size_t n, cudaStream_t stream) {
    buffer.reserve(n, stream);
    to_device(buffer.data(), host, n * sizeof(T), stream);
    return buffer.data();
  }

 private:
  class Chunk;

  bool pins(std::size_t bytes);
  void copy(char* to, const char* from, std::size_t bytes) const;
  void gather(char* to, const char* from, std::size_t element, std::span<const SphereRange> ranges,
              const Seen& seen) const;

  Team team_;
  std::array<std::unique_ptr<Chunk>, chunks> chunks_;
  std::size_t by_driver_ = 0;  ///< bytes of large arrays
  bool refused_ = false;       ///< there was no memory to pin
};

}  // namespace catena::cuda

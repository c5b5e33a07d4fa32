#pragma once
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/cuda/device_buffer.h"

namespace catena::cuda {

/// Owner of a hierarchy's arrays on the device; the host's twin is Hierarchy.
template <class Bound>
class DeviceTree {
 public:
  /// Room for n leaves; slots are left as they are.
  HierarchyView<Bound> reset(std::uint32_t n, cudaStream_t stream) {
    const std::size_t slots = n == 0 ? 0 : 2 * std::size_t{n} - 1;
    return {bound_.reserve(slots, stream), links_.reserve(slots, stream), n, 0, n == 0 ? 0u : 1u};
  }

 private:
  DeviceBuffer<Bound> bound_;
  DeviceBuffer<Links> links_;
};

}  // namespace catena::cuda

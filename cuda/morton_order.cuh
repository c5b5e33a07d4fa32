#pragma once
#include <cstdint>
#include <cub/device/device_radix_sort.cuh>

#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/morton_grid.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// The box of all centres, as numbers in the order of the floats they stand for.
struct OrderedBox {
  std::uint32_t low[3], high[3];
  __device__ static std::uint32_t ordered(float v) {
    const std::uint32_t bits = __float_as_uint(v);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
  }
  __device__ static float value(std::uint32_t v) { return __uint_as_float(v >> 31 ? v & 0x7FFFFFFFu : ~v); }
};

template <class Chain>
__global__ void __launch_bounds__(256) box_of_centres(const __grid_constant__ Chain chain, OrderedBox* box) {
  std::uint32_t low[3] = {~0u, ~0u, ~0u}, high[3] = {0, 0, 0};
  for (std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x; i < chain.size; i += gridDim.x * blockDim.x) {
    const Sphere s = chain.spheres[i];
    const float at[3] = {s.x, s.y, s.z};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = OrderedBox::ordered(at[k]);
      low[k] = min(low[k], v);
      high[k] = max(high[k], v);
    }
  }
  for (int k = 0; k < 3; ++k) {
    for (int step = 16; step > 0; step /= 2) {
      low[k] = min(low[k], __shfl_xor_sync(0xFFFFFFFFu, low[k], step));
      high[k] = max(high[k], __shfl_xor_sync(0xFFFFFFFFu, high[k], step));
    }
    if (threadIdx.x % 32 == 0) {
      atomicMin(&box->low[k], low[k]);
      atomicMax(&box->high[k], high[k]);
    }
  }
}

/// The cell along one axis of the box, of 2^21, two zeros after each bit.
__device__ inline std::uint64_t spread_cell(float at, double low, double cells_per_unit) {
  return spread_bits(static_cast<std::uint64_t>((at - low) * cells_per_unit));
}

template <class Chain>
__global__ void __launch_bounds__(256)
    morton_codes(const __grid_constant__ Chain chain, const OrderedBox* box, std::uint64_t* code,
                 std::uint32_t* id) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= chain.size) return;
  double low[3], side = 0;
  for (int k = 0; k < 3; ++k) {
    low[k] = OrderedBox::value(box->low[k]);
    side = fmax(side, OrderedBox::value(box->high[k]) - low[k]);
  }
  const double cells = side > 0 ? ((1 << 21) - 1) / side : 0;
  const Sphere s = chain.spheres[i];
  code[i] = spread_cell(s.x, low[0], cells) << 2 | spread_cell(s.y, low[1], cells) << 1 |
            spread_cell(s.z, low[2], cells);
  id[i] = i;
}

/// The spheres of a chain in order of the Morton codes of their centres, 21 bits an axis.
class MortonOrder {
 public:
  /// Enqueues it; afterwards code() and id() have it, until the next call.
  void enqueue(const ChainView& chain, cudaStream_t stream) {
    const std::uint32_t n = chain.size;
    OrderedBox* const box = box_.reserve(1, stream);
    CATENA_CUDA(cudaMemsetAsync(box->low, 0xFF, sizeof box->low, stream));
    CATENA_CUDA(cudaMemsetAsync(box->high, 0, sizeof box->high, stream));
    std::uint64_t *const unsorted = unsorted_code_.reserve(n, stream), *const sorted =
                                                                           code_.reserve(n, stream);
    std::uint32_t *const before = unsorted_id_.reserve(n, stream), *const after = id_.reserve(n, stream);
    launch_blocks(box_of_centres<ChainView>, n < 256 * 1056 ? (n + 255) / 256 : 1056, 256, stream, chain,
                  box);
    launch(morton_codes<ChainView>, n, 256, stream, chain, box, unsorted, before);
    const auto sort = [&](void* room, std::size_t& bytes) {
      CATENA_CUDA(
          cub::DeviceRadixSort::SortPairs(room, bytes, unsorted, sorted, before, after, n, 0, 63, stream));
    };
    std::size_t bytes = 0;
    sort(nullptr, bytes);
    sort(room_.reserve(bytes, stream), bytes);
  }

  const std::uint64_t* code() const { return code_.data(); }
  const std::uint32_t* id() const { return id_.data(); }

 private:
  DeviceBuffer<OrderedBox> box_;
  DeviceBuffer<std::uint64_t> unsorted_code_, code_;
  DeviceBuffer<std::uint32_t> unsorted_id_, id_;
  DeviceBuffer<std::uint8_t> room_;
};

}  // namespace catena::cuda

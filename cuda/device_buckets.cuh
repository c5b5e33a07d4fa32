#pragma once
#include <algorithm>
#include <cub/block/block_reduce.cuh>
#include <cub/block/block_scan.cuh>

#include "catena/core/cells/buckets.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// Of a block that allocates buckets, four a thread.
constexpr unsigned allocate_threads = 512;
constexpr std::uint32_t chunks_together = 4 * allocate_threads / Buckets::chunk;

/// The second step of a Buckets: counts become starts, and 0 again. Two chunks a block, four buckets a
/// thread; blocks take their places one after the other as they come. chunks() is asked on the device how
/// many, and chunks.square_sum() and chunks.in_crowds(), where they are not nullptr, get the sum of the
/// squares of all counts, about, and the sum of those that are Buckets::crowd or more.
template <class Chunks>
__global__ void __launch_bounds__(allocate_threads)
    allocate_buckets(const __grid_constant__ Buckets buckets, const __grid_constant__ Chunks chunks) {
  constexpr std::uint32_t of_chunk = Buckets::chunk / 4;  // threads
  using Scan = cub::BlockScan<std::uint32_t, allocate_threads>;
  using Sum = cub::BlockReduce<float, allocate_threads>;
  __shared__ typename Scan::TempStorage room;
  __shared__ typename Sum::TempStorage room_of_sum;
  __shared__ std::uint32_t base;
  await_previous();
  float* const square_sum = chunks.square_sum();
  std::uint32_t* const in_crowds = chunks.in_crowds();
  const std::uint32_t all = chunks();
  for (std::uint32_t from = blockIdx.x * chunks_together; from < all; from += gridDim.x * chunks_together) {
    const std::uint32_t chunk = from + threadIdx.x / of_chunk, k = threadIdx.x % of_chunk;
    const bool there = chunk < all;
    uint4* const count = reinterpret_cast<uint4*>(buckets.count + std::size_t{chunk} * Buckets::chunk) + k;
    const uint4 own = there ? *count : uint4{0, 0, 0, 0};
    const std::uint32_t sum = own.x + own.y + own.z + own.w;
    std::uint32_t before, total;
    Scan(room).ExclusiveSum(sum, before, total);
    if (threadIdx.x == 0) base = total > 0 ? atomicAdd(buckets.places, total) : 0;
    __syncthreads();
    const std::uint32_t first = base + before;
    if (there) {
      std::uint32_t* const to = buckets.start + Buckets::starts(chunk) + 4 * k;
      to[0] = first;
      to[1] = first + own.x;
      to[2] = first + own.x + own.y;
      to[3] = first + own.x + own.y + own.z;
      if (k == of_chunk - 1) to[4] = first + sum;
      if (sum != 0) *count = {0, 0, 0, 0};
    }
    if (in_crowds != nullptr && sum >= Buckets::crowd) {
      std::uint32_t crowds = 0;
      for (const std::uint32_t k : {own.x, own.y, own.z, own.w}) crowds += k >= Buckets::crowd ? k : 0;
      if (crowds != 0) atomicAdd(in_crowds, crowds);
    }
    if (square_sum != nullptr) {
      const auto square = [](std::uint32_t k) { return static_cast<float>(k) * static_cast<float>(k); };
      const float squares =
          Sum(room_of_sum).Sum(square(own.x) + square(own.y) + square(own.z) + square(own.w));
      if (threadIdx.x == 0 && squares > 0) atomicAdd(square_sum, squares);
    }
    __syncthreads();
  }
}

/// How many blocks do so, of that many chunks at most.
inline unsigned allocate_blocks(std::uint32_t chunks) {
  constexpr std::uint32_t most = 528;
  return std::min((chunks + chunks_together - 1) / chunks_together, most);
}

/// Memory of a Buckets on a device.
class DeviceBuckets {
 public:
  /// For that many things and a number of places that is 0 before they are allocated.
  Buckets reserve(const CellTable& table, std::size_t things, std::uint32_t* places, cudaStream_t stream) {
    const std::uint32_t chunks = Buckets::chunks(table);
    const std::size_t buckets = std::size_t{chunks} * Buckets::chunk;
    if (buckets > count_.capacity())  // between sorts all counts are 0
      CATENA_CUDA(
          cudaMemsetAsync(count_.reserve(buckets, stream), 0, buckets * sizeof(std::uint32_t), stream));
    return {count_.data(), start_.reserve(Buckets::starts(chunks), stream), rank_.reserve(things, stream),
            places};
  }

 private:
  DeviceBuffer<std::uint32_t> count_, start_, rank_;
};

}  // namespace catena::cuda

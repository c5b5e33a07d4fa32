#pragma once
#include <algorithm>

#include "catena/core/cells/search_cells.h"
#include "catena/core/strategy/request.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/near_queue.cuh"

namespace catena::cuda {

/// Which spheres of a chain a DeviceSphereCells sorts, asked on the device: members.takes(i), about
/// members.expected() of them, and not one unless members.any().
struct AllSpheres {
  std::uint32_t size;
  __device__ bool any() const { return true; }
  __device__ bool takes(std::uint32_t) const { return true; }
  __device__ std::uint32_t expected() const { return size; }
};

/// The calling thread's share of 0 .. count - 1.
template <class Body>
__device__ void for_each_of_mine(std::uint32_t count, const Body& body) {
  for (std::uint64_t k = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; k < count;
       k += std::uint64_t{gridDim.x} * blockDim.x)
    body(static_cast<std::uint32_t>(k));
}

template <class Members>
__global__ void __launch_bounds__(256)
    enter_cells(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                const __grid_constant__ Members members) {
  __shared__ std::uint32_t levels[Octaves::count / 32];  // all of a block's together, as they go to one place
  if (!members.any()) return;
  const CellTable& table = cells.table_for(members.expected());
  const bool several = !cells.octaves.one && threadIdx.x < Octaves::count / 32;
  if (several) levels[threadIdx.x] = 0;
  __syncthreads();
  for_each_of_mine(chain.size, [&](std::uint32_t i) {
    if (!members.takes(i)) return;
    const std::uint32_t octave = cells.enter(table, chain.spheres[i], i);
    if (!cells.octaves.one) set_bits(levels + octave / 32, 1u << octave % 32);
  });
  __syncthreads();
  if (several && levels[threadIdx.x] != 0) set_bits(cells.state->levels + threadIdx.x, levels[threadIdx.x]);
}

/// Counts become starts, and 0 again: a chunk a block, four buckets a thread. Chunks take their places one
/// after the other as they come.
template <class Members>
__global__ void __launch_bounds__(256)
    allocate_cells(const __grid_constant__ SphereCells cells, const __grid_constant__ Members members) {
  static_assert(SphereCells::chunk == 4 * 256);
  __shared__ std::uint32_t of_warp[8], base;
  if (!members.any()) return;
  const std::uint32_t chunks = SphereCells::chunks(cells.table_for(members.expected()));
  const std::uint32_t lane = threadIdx.x % 32, warp = threadIdx.x / 32;
  for (std::uint32_t chunk = blockIdx.x; chunk < chunks; chunk += gridDim.x) {
    uint4* const count =
        reinterpret_cast<uint4*>(cells.count + std::size_t{chunk} * SphereCells::chunk) + threadIdx.x;
    std::uint32_t* const start = cells.start + SphereCells::starts(chunk);
    const uint4 own = *count;
    const std::uint32_t sum = own.x + own.y + own.z + own.w;
    std::uint32_t upto = sum;
    for (std::uint32_t step = 1; step < 32; step *= 2) {
      const std::uint32_t before = __shfl_up_sync(0xFFFFFFFFu, upto, step);
      if (lane >= step) upto += before;
    }
    if (lane == 31) of_warp[warp] = upto;
    __syncthreads();
    if (threadIdx.x == 0) {
      std::uint32_t total = 0;
      for (std::uint32_t& w : of_warp) {
        const std::uint32_t spheres = w;
        w = total;
        total += spheres;
      }
      base = total > 0 ? atomicAdd(&cells.state->places, total) : 0;
      start[SphereCells::chunk] = base + total;
    }
    __syncthreads();
    const std::uint32_t first = base + of_warp[warp] + upto - sum;
    std::uint32_t* const to = start + 4 * threadIdx.x;
    to[0] = first;
    to[1] = first + own.x;
    to[2] = first + own.x + own.y;
    to[3] = first + own.x + own.y + own.z;
    if (sum != 0) *count = {0, 0, 0, 0};
    __syncthreads();
  }
}

template <class Members>
__global__ void __launch_bounds__(256)
    place_in_cells(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                   const __grid_constant__ Members members) {
  if (!members.any()) return;
  const CellTable& table = cells.table_for(members.expected());
  for_each_of_mine(chain.size, [&](std::uint32_t i) {
    if (members.takes(i)) cells.place(table, chain.spheres[i], i);
  });
}

template <class Members>
__global__ void __launch_bounds__(256)
    fill_places(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                const __grid_constant__ Members members) {
  if (!members.any()) return;
  for_each_of_mine(cells.state->places, [&](std::uint32_t place) { cells.fill(chain, place); });
}

/// In the order of places, in which the threads of a warp look into the same cells; where radii differ much
/// in that of the chain, in which they look into the same levels.
template <class Tests, class Members>
__global__ void __launch_bounds__(128, 8)
    search_cells(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                 const __grid_constant__ Members members, const __grid_constant__ ResidentAnswer answer,
                 SphereRange queries) {
  __shared__ NearQueue::Shared shared;
  if (cells.state->places == 0) return;
  NearQueue queue(shared, answer, queries);
  __syncthreads();
  const CellTable& table = cells.table_for(members.expected());
  const CellSearch<Tests, NearQueue> search(chain, cells, table, queue);
  const std::uint32_t count = cells.octaves.one ? cells.state->places : chain.size;
  for (std::uint64_t first = std::uint64_t{blockIdx.x} * blockDim.x; first < count;
       first += std::uint64_t{gridDim.x} * blockDim.x) {
    const bool inside = first + threadIdx.x < count && !queue.satisfied();
    const std::uint32_t k = inside ? static_cast<std::uint32_t>(first + threadIdx.x) : 0;
    const bool live = inside && (cells.octaves.one || members.takes(k));
    const Sphere s = cells.octaves.one ? cells.sphere[k] : chain.spheres[k];
    const std::uint32_t place = cells.octaves.one ? k : live ? cells.place_of(table, s, k) : 0;
    if (queue.any(live)) search.run(s, place, live);
    queue.flush(search);
  }
}

/// SphereCells on a device: its memory, and its steps as kernels, none of which the host waits for.
template <class Members>
class DeviceSphereCells {
 public:
  void enqueue_build(const ChainView& chain, const Members& members, cudaStream_t stream) {
    members_ = members;
    cells_ = SphereCells::of(chain.extent);
    const std::uint32_t n = chain.size, chunks = SphereCells::chunks(cells_.table_for(n));
    const std::size_t buckets = std::size_t{chunks} * SphereCells::chunk;
    if (buckets > count_.capacity())  // between builds all counts are 0
      CATENA_CUDA(
          cudaMemsetAsync(count_.reserve(buckets, stream), 0, buckets * sizeof(std::uint32_t), stream));
    cells_.count = count_.data();
    cells_.start = start_.reserve(SphereCells::starts(chunks), stream);
    cells_.rank = rank_.reserve(n, stream);
    cells_.index = index_.reserve(n, stream);
    cells_.sphere = sphere_.reserve(n, stream);
    cells_.state = state_.reserve(1, stream);
    CATENA_CUDA(cudaMemsetAsync(cells_.state, 0, sizeof *cells_.state, stream));
    if (n == 0) return;
    const unsigned blocks = std::min((n + 255) / 256, most_blocks);
    launch_blocks(enter_cells<Members>, blocks, 256, stream, chain, cells_, members_);
    launch_blocks(allocate_cells<Members>, std::min(chunks, most_blocks), 256, stream, cells_, members_);
    launch_blocks(place_in_cells<Members>, blocks, 256, stream, chain, cells_, members_);
    launch_blocks(fill_places<Members>, blocks, 256, stream, chain, cells_, members_);
  }

  template <class Tests>
  void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      cudaStream_t stream) const {
    launch_blocks(search_cells<Tests, Members>, std::min((chain.size + 127) / 128, 2 * most_blocks), 128,
                  stream, chain, cells_, members_, answer, request.queries.within(chain.size));
  }

 private:
  static constexpr std::uint32_t most_blocks = 2112;  ///< of a kernel: each loops over its share

  Members members_{};
  SphereCells cells_{};
  DeviceBuffer<std::uint32_t> count_, start_, rank_, index_;
  DeviceBuffer<Sphere> sphere_;
  DeviceBuffer<SphereCells::State> state_;
};

}  // namespace catena::cuda

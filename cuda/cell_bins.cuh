#pragma once
#include <algorithm>
#include <cub/block/block_load.cuh>
#include <cub/block/block_reduce.cuh>
#include <cub/block/block_scan.cuh>
#include <cub/block/block_store.cuh>
#include <limits>

#include "catena/core/cells/sphere_cells.h"
#include "catena/core/parameters/parameters.h"
#include "catena/cuda/device_buckets.cuh"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/members.cuh"

namespace catena::cuda {

/// Spheres on their way into the cells of one level, sorted by *bins*: buckets in a row, as many as a thread
/// block can count in shared memory. Straight from the chain into its cell each sphere is written to a place
/// of its own somewhere in memory; what goes to few places at a time, and within each to its neighbourhood,
/// is written several times as fast. Plain pointers into a device's memory.
struct CellBins {
  static constexpr std::uint32_t most = 16384, threads = 512, put_together = 8 * threads;

  std::uint32_t* count;  ///< by bin; all 0 between sorts
  std::uint32_t* begin;  ///< by bin, and one more: where it begins in `sphere`
  std::uint32_t* next;   ///< by bin: where the next sphere that comes goes
  Sphere* sphere;        ///< as SphereCells::sphere
  std::uint32_t* index;  ///< as SphereCells::index

  /// Buckets of a bin are 2 to the power of this; whole chunks of Buckets. Those bins that are sorted at a
  /// time should have room in the device's cache with what they are sorted to, but each asks for more places.
  CATENA_HD static std::uint32_t log2_buckets(const CellTable& table) {
    const std::uint64_t bins = table.buckets > many_buckets ? most : most / 2;
    std::uint32_t log2 = least_log2;
    while (bins << log2 < table.buckets) ++log2;
    return log2;
  }
  CATENA_HD static std::uint32_t bins(const CellTable& table) {
    return ((table.buckets - 1) >> log2_buckets(table)) + 1;
  }
  /// A thread block sorts a bin: with more in one than this it is left to place_in_cells.
  CATENA_HD static std::uint32_t most_in_one(std::uint32_t spheres) {
    return spheres / 128 > 8192 ? spheres / 128 : 8192;
  }

 private:
  static constexpr std::uint32_t least_log2 = 10, many_buckets = 1u << 24;
  static_assert(1u << least_log2 == Buckets::chunk);
};

template <class Members>
__global__ void __launch_bounds__(CellBins::threads, 3)
    count_in_bins(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                  const __grid_constant__ CellBins bins, const __grid_constant__ Members members) {
  extern __shared__ std::uint32_t of_bins[];
  await_previous();
  if (!members.any()) return;
  const CellTable& table = cells.table_for(members.expected());
  const std::uint32_t log2 = CellBins::log2_buckets(table), all = CellBins::bins(table);
  for (std::uint32_t bin = threadIdx.x; bin < all; bin += blockDim.x) of_bins[bin] = 0;
  __syncthreads();
  for_members_together(
      members, [&](std::uint32_t i) { return chain.spheres[i]; },
      [&](std::uint32_t, const Sphere& s) {
        atomicAdd(of_bins + (cells.bucket_of(table, s, 0) >> log2), 1u);
      });
  __syncthreads();
  for (std::uint32_t bin = threadIdx.x; bin < all; bin += blockDim.x)
    if (of_bins[bin] != 0) atomicAdd(bins.count + bin, of_bins[bin]);
}

/// By one block, some bins at a time: counts become begins, and 0 again.
template <class Members>
__global__ void __launch_bounds__(1024)
    begin_bins(const __grid_constant__ SphereCells cells, const __grid_constant__ CellBins bins,
               const __grid_constant__ Members members) {
  constexpr std::uint32_t threads = 1024, own = 4;
  static_assert(CellBins::most % (threads * own) == 0);
  using Scan = cub::BlockScan<std::uint32_t, threads>;
  using Reduce = cub::BlockReduce<std::uint32_t, threads>;
  __shared__ typename Scan::TempStorage room;
  __shared__ typename Reduce::TempStorage room_of_greatest;
  await_previous();
  if (!members.any()) return;
  const std::uint32_t all = CellBins::bins(cells.table_for(members.expected()));
  std::uint32_t base = 0, greatest = 0;
  for (std::uint32_t first = 0; first < all; first += threads * own) {
    std::uint32_t count[own], begin[own], sum;
    cub::LoadDirectBlockedVectorized(threadIdx.x, bins.count + first, count);
    for (const std::uint32_t of_bin : count) greatest = max(greatest, of_bin);
    Scan(room).ExclusiveSum(count, begin, sum);
    for (std::uint32_t& from : begin) from += base;
    for (std::uint32_t& of_bin : count) of_bin = 0;
    cub::StoreDirectBlockedVectorized(threadIdx.x, bins.count + first, count);
    cub::StoreDirectBlockedVectorized(threadIdx.x, bins.begin + first, begin);
    cub::StoreDirectBlockedVectorized(threadIdx.x, bins.next + first, begin);
    base += sum;
    __syncthreads();
  }
  greatest =
      Reduce(room_of_greatest).Reduce(greatest, [](std::uint32_t a, std::uint32_t b) { return max(a, b); });
  if (threadIdx.x != 0) return;
  bins.begin[all] = base;
  if (base == 0 || greatest > CellBins::most_in_one(base)) return;
  cells.state->in_bins = 1;  // for the kernels after this one
  cells.state->places[0] = base;
}

/// Each block takes spheres that follow one another, as most of these go to few bins.
template <class Members>
__global__ void __launch_bounds__(CellBins::threads, 2)
    put_in_bins(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                const __grid_constant__ CellBins bins, const __grid_constant__ Members members) {
  constexpr std::uint32_t own = CellBins::put_together / CellBins::threads;
  extern __shared__ std::uint32_t of_bins[];  // how many came, then where the first of them goes
  await_previous();
  if (cells.state->in_bins == 0) return;
  const CellTable& table = cells.table_for(members.expected());
  const std::uint32_t log2 = CellBins::log2_buckets(table), all = CellBins::bins(table);
  const std::uint32_t asked = members.asked();
  for (std::uint64_t first = std::uint64_t{blockIdx.x} * CellBins::put_together; first < asked;
       first += std::uint64_t{gridDim.x} * CellBins::put_together) {
    for (std::uint32_t b = threadIdx.x; b < all; b += blockDim.x) of_bins[b] = 0;
    std::uint32_t bin[own], rank[own];
    Member member[own];
    Sphere sphere[own];
#pragma unroll
    for (std::uint32_t k = 0; k < own; ++k)
      member[k] = Member(members, asked, first + k * CellBins::threads + threadIdx.x);
#pragma unroll
    for (std::uint32_t k = 0; k < own; ++k) sphere[k] = chain.spheres[member[k].sphere];
    __syncthreads();
#pragma unroll
    for (std::uint32_t k = 0; k < own; ++k)
      if (member[k].in) {
        bin[k] = cells.bucket_of(table, sphere[k], 0) >> log2;
        rank[k] = atomicAdd(of_bins + bin[k], 1u);
      }
    __syncthreads();
    for (std::uint32_t b = threadIdx.x; b < all; b += blockDim.x)
      if (of_bins[b] != 0) of_bins[b] = atomicAdd(bins.next + b, of_bins[b]);
    __syncthreads();
#pragma unroll
    for (std::uint32_t k = 0; k < own; ++k)
      if (member[k].in)
        cells.put({bins.sphere, bins.index}, sphere[k], member[k].sphere, of_bins[bin[k]] + rank[k]);
    __syncthreads();
  }
}

/// A block a bin.
template <class Members>
__global__ void __launch_bounds__(CellBins::threads)
    sort_bins(const __grid_constant__ SphereCells cells, const __grid_constant__ CellBins bins,
              const __grid_constant__ Members members) {
  constexpr std::uint32_t own = Buckets::chunk / CellBins::threads, together = 4;
  extern __shared__ std::uint32_t next[];  // by bucket of the bin
  using Scan = cub::BlockScan<std::uint32_t, CellBins::threads>;
  using Sum = cub::BlockReduce<float, CellBins::threads>;
  __shared__ typename Scan::TempStorage room;
  __shared__ typename Sum::TempStorage room_of_sum;
  await_previous();
  if (cells.state->in_bins == 0) return;
  const CellTable& table = cells.table_for(members.expected());
  const std::uint32_t buckets = 1u << CellBins::log2_buckets(table), all = CellBins::bins(table),
                      chunks = Buckets::chunks(table);
  float squares = 0;
  for (std::uint32_t bin = blockIdx.x; bin < all; bin += gridDim.x) {
    const std::uint32_t begin = bins.begin[bin], end = bins.begin[bin + 1];
    const auto for_each = [&](const auto& body) {
      for (std::uint32_t first = begin + threadIdx.x; first < end; first += together * blockDim.x) {
        Sphere sphere[together];
#pragma unroll
        for (std::uint32_t k = 0; k < together; ++k)
          if (first + k * blockDim.x < end) sphere[k] = bins.sphere[first + k * blockDim.x];
#pragma unroll
        for (std::uint32_t k = 0; k < together; ++k)
          if (first + k * blockDim.x < end)
            body(first + k * blockDim.x, sphere[k], cells.bucket_of(table, sphere[k], 0) & (buckets - 1));
      }
    };
    for (std::uint32_t k = threadIdx.x; k < buckets; k += blockDim.x) next[k] = 0;
    __syncthreads();
    for_each([&](std::uint32_t, const Sphere&, std::uint32_t bucket) { atomicAdd(next + bucket, 1u); });
    __syncthreads();
    std::uint32_t base = begin;
    for (std::uint32_t at = 0; at < buckets; at += Buckets::chunk) {
      const std::uint32_t chunk = (bin * buckets + at) / Buckets::chunk;
      if (chunk >= chunks) break;
      std::uint32_t count[own], before[own], sum;
      for (std::uint32_t k = 0; k < own; ++k) {
        count[k] = next[at + own * threadIdx.x + k];
        squares += static_cast<float>(count[k]) * static_cast<float>(count[k]);
      }
      Scan(room).ExclusiveSum(count, before, sum);
      std::uint32_t* const start = cells.buckets.start + Buckets::starts(chunk);
      for (std::uint32_t k = 0; k < own; ++k)
        start[own * threadIdx.x + k] = next[at + own * threadIdx.x + k] = base + before[k];
      base += sum;
      if (threadIdx.x == 0) start[Buckets::chunk] = base;
      __syncthreads();
    }
    for_each([&](std::uint32_t k, const Sphere& sphere, std::uint32_t bucket) {
      const std::uint32_t place = atomicAdd(next + bucket, 1u);
      cells.sphere[place] = sphere;
      if (!cells.octaves.equal) cells.index[place] = bins.index[k];
    });
    __syncthreads();
  }
  squares = Sum(room_of_sum).Sum(squares);
  if (threadIdx.x == 0 && squares > 0 && !cells.octaves.one) atomicAdd(&cells.state->together, squares);
}

/// The parameter that says which chains go through bins.
inline ParameterInfo binned_parameter() {
  return {"binned", "1500000", "chains of fewer spheres go into cells without bins"};
}

/// Memory of CellBins on a device, and their kernels.
class DeviceCellBins {
 public:
  /// Spheres of a chain that are not too many in one bin have their places in cells.sphere then, and these
  /// cells their starts; state->in_bins says whether that is done: not without the memory for it.
  template <class Members>
  void enqueue(const ChainView& chain, const SphereCells& cells, const Members& members,
               cudaStream_t stream) {
    if (chain.size >= refused_) return;
    const CellTable& largest = cells.table_for(chain.size);
    const std::size_t of_buckets = sizeof(std::uint32_t) << CellBins::log2_buckets(largest),
                      of_bins = sizeof(std::uint32_t) * most_bins(cells, chain.size);
    if (std::max(of_buckets, of_bins) > most_shared()) return;
    if (CellBins::most > count_.capacity())  // between sorts all counts are 0
      CATENA_CUDA(cudaMemsetAsync(count_.reserve(CellBins::most, stream), 0,
                                  CellBins::most * sizeof(std::uint32_t), stream));
    CellBins bins{count_.data(), begin_.reserve(CellBins::most + 1, stream),
                  next_.reserve(CellBins::most, stream), nullptr, nullptr};
    if (!sphere_.try_reserve(chain.size, stream) ||
        (!cells.octaves.equal && !index_.try_reserve(chain.size, stream))) {
      give_back(stream);
      refused_ = chain.size;
      return;
    }
    bins.sphere = sphere_.data(), bins.index = index_.data();
    const auto blocks = [&](std::uint32_t together, unsigned most) {
      return std::min((chain.size + together - 1) / together, most);
    };
    launch_next_sharing<count_in_bins<Members>>(blocks(CellBins::threads, 396), CellBins::threads, of_bins,
                                                stream, chain, cells, bins, members);
    launch_next<begin_bins<Members>>(1, 1024, stream, cells, bins, members);
    launch_next_sharing<put_in_bins<Members>>(blocks(CellBins::put_together, 1056), CellBins::threads,
                                              of_bins, stream, chain, cells, bins, members);
    launch_next_sharing<sort_bins<Members>>(CellBins::bins(largest), CellBins::threads, of_buckets, stream,
                                            cells, bins, members);
  }

  /// The memory by the number of spheres, for what needs it more, and from now on goes without: false when there is
  /// none of it. Whoever was refused does not ask again either, as a recorded graph would, where it is warm.
  bool give_back(cudaStream_t stream) {
    const std::size_t room = std::max(sphere_.capacity(), index_.capacity());
    if (room > 0) refused_ = std::min(refused_, room);
    sphere_.release(stream), index_.release(stream);
    return room > 0;
  }

 private:
  /// Of any table that so many spheres or fewer may have.
  static std::uint32_t most_bins(const SphereCells& cells, std::uint32_t spheres) {
    const CellTable* const largest = &cells.table_for(spheres);
    std::uint32_t most = 0;
    for (const CellTable* table = cells.table; table <= largest; ++table)
      most = std::max(most, CellBins::bins(*table));
    return most;
  }
  /// Bytes that a block can have beside what the kernel itself has.
  static std::size_t most_shared() {
    int device = 0, shared = 0;
    CATENA_CUDA(cudaGetDevice(&device));
    CATENA_CUDA(cudaDeviceGetAttribute(&shared, cudaDevAttrMaxSharedMemoryPerBlockOptin, device));
    return static_cast<std::size_t>(shared) - (8 << 10);
  }

  DeviceBuffer<std::uint32_t> count_, begin_, next_, index_;
  DeviceBuffer<Sphere> sphere_;
  std::size_t refused_ = std::numeric_limits<std::size_t>::max();  ///< there is no room for so many spheres
};

}  // namespace catena::cuda

#pragma once
#include <algorithm>

#include "catena/core/cells/search_cells.h"
#include "catena/core/strategy/request.h"
#include "catena/cuda/cell_bins.cuh"
#include "catena/cuda/clear_by_block.cuh"
#include "catena/cuda/device_buckets.cuh"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/members.cuh"
#include "catena/cuda/near_queue.cuh"
#include "catena/cuda/share.cuh"

namespace catena::cuda {

/// fetch_add(count + bucket, 1) of each thread that is `in`, by all of a warp together: one operation for
/// those that follow one another with one bucket, so that a crowd waits for a few of them only.
__device__ inline std::uint32_t enter_together(std::uint32_t* count, std::uint32_t bucket, bool in) {
  constexpr std::uint32_t none = ~0u;
  const std::uint32_t lane = DeviceWarp::lane(), own = in ? bucket : none,
                      before = __shfl_up_sync(DeviceWarp::all, own, 1),
                      firsts = __ballot_sync(DeviceWarp::all, lane == 0 || before != own),
                      to_own = DeviceWarp::lanes_before() | 1u << lane, later = firsts & ~to_own;
  const int first = 31 - __clz(firsts & to_own);
  const std::uint32_t end = later != 0 ? __ffs(later) - 1 : DeviceWarp::lanes;
  std::uint32_t begin = 0;
  if (in && first == static_cast<int>(lane)) begin = fetch_add(count + bucket, end - lane);
  return __shfl_sync(DeviceWarp::all, begin, first) + lane - static_cast<std::uint32_t>(first);
}

/// Whether a kernel that enters spheres is the first to see their cells' state, and so sets it to 0: while
/// some of its blocks enter already, so that to enter, and to ask of members, may not look at the state then.
enum class Begin { cleared, anew };
/// By all threads; false where there is nothing to enter.
template <class Members>
__device__ bool begin_to_enter(const SphereCells& cells, const Members& members, Begin begin) {
  if (begin == Begin::cleared) return members.any() && cells.state->in_bins == 0;
  if (blockIdx.x == 0) clear_by_block(cells.state);
  return members.any();
}

/// enter_cells where radii are mixed, and many small ones may be in a cell of the largest.
template <class Members>
__global__ void __launch_bounds__(Members::threads)
    enter_mixed(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                const __grid_constant__ Members members, Begin begin) {
  await_previous();
  if (members.any())  // for enter_octaves
    for_each_of_mine(cells.map.words(), [&](std::uint32_t k) { cells.map.word[k] = 0; });
  if (!begin_to_enter(cells, members, begin)) return;
  const CellTable& table = cells.table_for(members.expected());
  const std::uint32_t asked = members.asked(), lane = DeviceWarp::lane();
  const std::uint64_t thread = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x;
  for (std::uint64_t first = thread - lane; first < asked; first += std::uint64_t{gridDim.x} * blockDim.x) {
    const Member member(members, asked, first + lane);
    const std::uint32_t bucket = member.in ? cells.bucket_of(table, chain.spheres[member.sphere], 0) : 0,
                        rank = enter_together(cells.buckets.count, bucket, member.in);
    if (member.in) cells.buckets.rank[member.sphere] = rank;
  }
}

template <class Members>
__global__ void __launch_bounds__(Members::threads)
    enter_cells(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                const __grid_constant__ Members members, Begin begin) {
  await_previous();
  if (!begin_to_enter(cells, members, begin)) return;
  const CellTable& table = cells.table_for(members.expected());
  for_members_together(
      members,
      [&](std::uint32_t i) {
        return fetch_add(cells.buckets.count + cells.bucket_of(table, chain.spheres[i], 0), 1);
      },
      [&](std::uint32_t i, std::uint32_t rank) { cells.buckets.rank[i] = rank; });
}

/// Anew, by octaves, where there are too many in the cells of one level.
template <class Members>
__global__ void __launch_bounds__(Members::threads)
    enter_octaves(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                  const __grid_constant__ Members members) {
  constexpr std::uint32_t words = Octaves::count / 32;
  __shared__ std::uint32_t levels[words];  // all of a block's together, as they go to one place
  __shared__ LevelBox box[Octaves::count];
  const auto for_each_end = [](const auto& body) {
    for (std::uint32_t k = threadIdx.x; k < Octaves::count * LevelBox::ends; k += blockDim.x)
      body(k / LevelBox::ends, k % LevelBox::ends);
  };
  await_previous();
  if (!cells.many_together()) return;
  if (blockIdx.x == 0 && threadIdx.x == 0) cells.state->by_octaves = 1;  // for the kernels after this one
  if (threadIdx.x < words) levels[threadIdx.x] = 0;
  for_each_end([&](std::uint32_t level, std::uint32_t end) { box[level].clear_end(end); });
  __syncthreads();
  const CellTable& table = cells.table_for(members.expected());
  for_each_member(members, [&](std::uint32_t i) {
    const Sphere s = chain.spheres[i];
    const std::uint32_t octave = cells.octaves.of(s.radius);
    cells.enter_octave(table, s, i, octave);
    set_bits(levels + octave / 32, 1u << octave % 32);
    box[octave].join(LevelBox::Ends(Box::around(s)));
  });
  __syncthreads();
  for_each_end([&](std::uint32_t level, std::uint32_t end) {
    if (box[level].end(end) != 0) cells.state->box[level].join_end(end, box[level].end(end));
  });
  if (threadIdx.x < words && levels[threadIdx.x] != 0)
    set_bits(cells.state->levels + threadIdx.x, levels[threadIdx.x]);
}

/// What allocate_buckets asks after each of the two.
template <class Members, bool octaves>
struct CellChunks {
  SphereCells cells;
  Members members;
  __device__ std::uint32_t operator()() const {
    const bool needed = octaves ? cells.many_together() : members.any() && cells.state->in_bins == 0;
    return needed ? Buckets::chunks(cells.table_for(members.expected())) : 0;
  }
  __device__ float* square_sum() const {
    return octaves || cells.octaves.one ? nullptr : &cells.state->together;
  }
  __device__ std::uint32_t* in_crowds() const { return octaves ? nullptr : &cells.state->in_crowds; }
};

template <class Members>
__global__ void __launch_bounds__(Members::threads)
    place_in_cells(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                   const __grid_constant__ Members members) {
  await_previous();
  if (!members.any() || (cells.state->in_bins != 0 && cells.one_level())) return;
  const CellTable& table = cells.table_for(members.expected());
  struct Placed {
    Sphere sphere;
    std::uint32_t at;
  };
  for_members_together(
      members,
      [&](std::uint32_t i) {
        const Sphere s = chain.spheres[i];
        return Placed{s, cells.place_of(table, s, i)};
      },
      [&](std::uint32_t i, const Placed& placed) { cells.put(placed.sphere, i, placed.at); });
}

/// Of a block that searches cells.
constexpr unsigned search_threads = 128;
using CellsQueue = NearQueue<search_threads>;

/// Of spheres in one level; in the order of places, in which the threads of a warp look into the same cells.
template <class Tests, bool equal_radii, class Members>
__global__ void __launch_bounds__(search_threads, 1024 / search_threads)
    search_one_level(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                     const __grid_constant__ Members members, const __grid_constant__ ResidentAnswer answer,
                     SphereRange queries) {
  __shared__ CellsQueue::Shared shared;
  await_previous();
  const std::uint32_t places = cells.one_level() ? cells.places() : 0;
  if (places == 0) return;
  CellsQueue queue(shared, answer, queries);
  __syncthreads();
  const CellSearch<Tests, equal_radii, CellsQueue> search(chain, cells, cells.table_for(members.expected()),
                                                          queue);
  const PlacedSpheres<equal_radii> placed(cells);
  const Share share(places, cells.uneven());
  for (std::uint32_t round = 0; share.any(round) && !queue.satisfied(); ++round) {
    const std::uint64_t at = share.at(round);
    const bool live = at < places;
    const std::uint32_t place = live ? static_cast<std::uint32_t>(at) : 0;
    search.run_in_one_level(placed.at(place), place, live);
    queue.flush(search);
  }
  queue.finish();
}

/// Of spheres that were sorted by octaves, in the order of the members.
template <class Tests, class Members>
__global__ void __launch_bounds__(search_threads, 1024 / search_threads)
    search_octaves(const __grid_constant__ ChainView chain, const __grid_constant__ SphereCells cells,
                   const __grid_constant__ Members members, const __grid_constant__ ResidentAnswer answer,
                   SphereRange queries) {
  __shared__ CellsQueue::Shared shared;
  await_previous();
  if (cells.one_level()) return;
  CellsQueue queue(shared, answer, queries);
  __syncthreads();
  const CellTable& table = cells.table_for(members.expected());
  const CellSearch<Tests, false, CellsQueue> search(chain, cells, table, queue);
  const std::uint32_t asked = members.asked();
  const Share share(asked, true);
  for (std::uint32_t round = 0; share.any(round) && !queue.satisfied(); ++round) {
    const std::uint64_t at = share.at(round);
    const bool inside = at < asked;
    const std::uint32_t k = inside ? static_cast<std::uint32_t>(at) : 0;
    const bool live = inside && members.takes(k);
    if (queue.any(live)) {
      const std::uint32_t i = live ? members.sphere(k) : 0;
      const Sphere s = chain.spheres[i];
      search.run({s, i}, live ? cells.place_of(table, s, i) : 0, live);
    }
    queue.flush(search);
  }
  queue.finish();
}

/// SphereCells on a device: its memory, and its steps as kernels, none of which the host waits for.
class DeviceSphereCells {
 public:
  /// Chains of at least `binned` spheres go through bins. `state` need not be 0 where begin is Begin::anew.
  template <class Members>
  void enqueue_build(const ChainView& chain, const Members& members, std::uint64_t binned,
                     SphereCells::State* state, Begin begin, cudaStream_t stream) {
    cells_ = SphereCells::of(chain.extent);
    const std::uint32_t n = chain.size;
    const CellTable& largest = cells_.table_for(n);
    cells_.buckets = buckets_.reserve(largest, n, &state->places[0], stream);
    if (!cells_.octaves.equal) cells_.index = index_.reserve(n, stream);
    const std::size_t room = n + std::size_t{SphereCells::at_once};
    if (room > sphere_.capacity())  // so that what is read behind the last place was written
      CATENA_CUDA(cudaMemsetAsync(sphere_.reserve(room, stream), 0, room * sizeof(Sphere), stream));
    cells_.sphere = sphere_.data();
    cells_.map = LevelMap::of(n);
    if (!cells_.octaves.one) cells_.map.word = map_.reserve(cells_.map.words(), stream);
    cells_.state = state;
    if (n == 0) return;
    if (n >= binned && n <= most_binned) {
      if (begin == Begin::anew) CATENA_CUDA(cudaMemsetAsync(state, 0, sizeof *state, stream));
      begin = Begin::cleared;
      bins_.enqueue(chain, cells_, members, stream);
    }
    const unsigned blocks = std::min((n + Members::threads - 1) / Members::threads, Members::most_blocks);
    if (cells_.octaves.one)
      launch_next<enter_cells<Members>>(blocks, Members::threads, stream, chain, cells_, members, begin);
    else
      launch_next<enter_mixed<Members>>(blocks, Members::threads, stream, chain, cells_, members, begin);
    const unsigned chunks = allocate_blocks(Buckets::chunks(largest));
    allocate<false>(chunks, members, stream);
    if (!cells_.octaves.one) {
      cells_.buckets.places = &state->places[1];
      launch_next<enter_octaves<Members>>(blocks, Members::threads, stream, chain, cells_, members);
      allocate<true>(chunks, members, stream);
    }
    launch_next<place_in_cells<Members>>(blocks, Members::threads, stream, chain, cells_, members);
  }

  /// Of the same members. Comes after another kernel, or after anything that a stream waits for.
  template <class Tests, class Members>
  void enqueue_search(const ChainView& chain, const Members& members, const Request& request,
                      const ResidentAnswer& answer, cudaStream_t stream) const {
    const auto search = [&](auto kernel) {
      launch_next<kernel.value>(
          std::min((chain.size + search_threads - 1) / search_threads, Members::most_search_blocks),
          search_threads, stream, chain, cells_, members, answer, request.queries.within(chain.size));
    };
    if (cells_.octaves.equal)
      search(Kernel<search_one_level<Tests, true, Members>>());
    else
      search(Kernel<search_one_level<Tests, false, Members>>());
    if (!cells_.octaves.one) search(Kernel<search_octaves<Tests, Members>>());
  }

  /// Memory that the build took and the search does without; false when there is none.
  bool give_back(cudaStream_t stream) { return bins_.give_back(stream); }

  /// On the device, of the last build.
  const SphereCells& cells() const { return cells_; }

 private:
  static constexpr std::uint32_t most_binned = 1u << 29;  ///< more need the memory for themselves

  template <auto kernel>
  struct Kernel {
    static constexpr auto value = kernel;
  };

  template <bool octaves, class Members>
  void allocate(unsigned blocks, const Members& members, cudaStream_t stream) const {
    const CellChunks<Members, octaves> chunks{cells_, members};
    launch_next<allocate_buckets<CellChunks<Members, octaves>>>(blocks, allocate_threads, stream,
                                                                cells_.buckets, chunks);
  }

  SphereCells cells_{};
  DeviceBuckets buckets_;
  DeviceCellBins bins_;
  DeviceBuffer<std::uint32_t> index_, map_;
  DeviceBuffer<Sphere> sphere_;
};

}  // namespace catena::cuda

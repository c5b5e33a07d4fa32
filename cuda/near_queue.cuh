#pragma once
#include "catena/core/cells/search_cells.h"
#include "catena/cuda/pair_stage.cuh"

namespace catena::cuda {

/// The sink of a search in a kernel: gathers who is near, to decide it by all threads of the block alike, as
/// threads find very different numbers of them. Each thread asks for one sphere at a time.
template <std::uint32_t threads>
class NearQueue {
 public:
  static constexpr std::uint32_t room = 10 * threads;
  struct Shared {
    struct Near {
      std::uint32_t at;
      std::uint16_t thread, level;
    } near[room];                  ///< of a thread's sphere
    std::uint32_t place[threads];  ///< by thread: whose are these
    std::uint32_t met[threads];    ///< by thread: how many of these collided
    std::uint32_t used;
    typename PairStage<threads>::Shared pairs;
  };

  /// By all threads of the block, which then synchronize.
  __device__ NearQueue(Shared& shared, const ResidentAnswer& answer, SphereRange queries)
      : shared_(shared), pairs_(shared.pairs, answer, queries) {
    shared_.met[threadIdx.x] = 0;
    if (threadIdx.x == 0) shared_.used = 0;
  }

  /// By all threads of a warp together.
  template <class Search, std::size_t sets>
  __device__ void near(const Search& search, std::uint32_t place, std::uint32_t level,
                       const PlaceSet (&near)[sets]) {
    std::uint32_t own = 0;
    for (const PlaceSet& set : near) own += __popc(set.bits);
    const LaneSum sum = LaneSum::of(own);
    if (sum.all == 0) return;
    shared_.place[threadIdx.x] = place;
    const std::uint32_t first = DeviceWarp::add_once(&shared_.used, sum.all);
    std::uint32_t k = first + sum.before;
    if (first + sum.all <= room) {  // mostly: without the rare path in the loop
#pragma unroll
      for (const PlaceSet& set : near)
        for (std::uint32_t bits = set.bits; bits != 0; bits &= bits - 1)
          put(k++, set.first + lowest_bit(bits), level);
    } else {
#pragma unroll
      for (const PlaceSet& set : near) put_or_decide(search, k, place, level, set);
    }
    converge();
  }
  template <class Search>
  __device__ void near_too(const Search& search, std::uint32_t place, std::uint32_t level, PlaceSet set) {
    if (set.bits == 0) return;
    shared_.place[threadIdx.x] = place;
    std::uint32_t k = atomicAdd(&shared_.used, __popc(set.bits));
    put_or_decide(search, k, place, level, set);
  }
  __device__ bool satisfied() const { return pairs_.satisfied(); }
  /// These two by all threads of a warp together.
  __device__ void converge() const { __syncwarp(); }
  __device__ bool any(bool own) const { return __any_sync(DeviceWarp::all, own); }

  /// Decides what was gathered and brings what collides to the answer. By all threads of the block together.
  template <class Search>
  __device__ void flush(const Search& search) {
    __syncthreads();
    const std::uint32_t queued = min(shared_.used, room);
    for (std::uint32_t first = 0; first < queued; first += blockDim.x) {
      const std::uint32_t k = first + threadIdx.x;
      Met met{0, 0, false};
      if (k < queued) {
        const typename Shared::Near near = shared_.near[k];
        met = search.met(shared_.place[near.thread], near.at, near.level);
        if (met.collide) {
          atomicAdd(&shared_.met[near.thread], 1u);
          pairs_.count(met.j, 1);
        }
      }
      pairs_.keep_of_warp(met.collide, min(met.i, met.j), max(met.i, met.j));
    }
    __syncthreads();
    if (const std::uint32_t met = shared_.met[threadIdx.x]; met != 0) {
      pairs_.count(search.sphere_at(shared_.place[threadIdx.x]), met);
      shared_.met[threadIdx.x] = 0;
    }
    if (threadIdx.x == 0) shared_.used = 0;
    pairs_.flush();  // with a barrier
  }

 private:
  __device__ void put(std::uint32_t k, std::uint32_t at, std::uint32_t level) {
    shared_.near[k] = {at, static_cast<std::uint16_t>(threadIdx.x), static_cast<std::uint16_t>(level)};
  }
  /// As far as there is room; the others are decided at once.
  template <class Search>
  __device__ void put_or_decide(const Search& search, std::uint32_t& k, std::uint32_t place,
                                std::uint32_t level, PlaceSet set) {
    for (; set.bits != 0; set.bits &= set.bits - 1, ++k) {
      const std::uint32_t at = set.first + lowest_bit(set.bits);
      if (k < room) {
        put(k, at, level);
      } else if (const Met met = search.met(place, at, level); met.collide) {
        pairs_.pair(min(met.i, met.j), max(met.i, met.j));
      }
    }
  }

  Shared& shared_;
  PairStage<threads> pairs_;
};

}  // namespace catena::cuda

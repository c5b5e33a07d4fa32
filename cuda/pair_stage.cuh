#pragma once
#include <cstdint>

#include "catena/core/strategy/request.h"
#include "catena/core/strategy/resident.h"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/store_pair.cuh"

namespace catena::cuda {

/// Where the warps of a block gather pairs, each met once, before they go to the answer: by one atomic
/// operation on the answer's number for what a warp has room for, and for what all have at the end. A single
/// number takes some 3 ns for each operation, whoever asks.
template <std::uint32_t threads>
class PairStage {
 public:
  static constexpr std::uint32_t warps = threads / DeviceWarp::lanes, room = 512;
  struct Shared {
    Pair pairs[warps][room];
    std::uint32_t kept[warps];
    unsigned long long first;  ///< place in the answer of the first of these
    bool satisfied;
  };

  /// By all threads of the block, which then synchronize.
  __device__ PairStage(Shared& shared, const ResidentAnswer& answer, SphereRange queries)
      : shared_(shared), answer_(answer), queries_(queries) {
    if (threadIdx.x == 0)
      shared_.satisfied = answer_.count == nullptr && answer_.pairs == nullptr &&
                          *static_cast<volatile unsigned long long*>(&answer_.state->found) > 0;
  }

  /// By all threads of a warp together: keeps pair(lane) of each lane whose bit is set.
  template <class PairOf>
  __device__ void collide(std::uint32_t lanes, const PairOf& pair) {
    const Pair own = pair(DeviceWarp::lane());
    const bool keeps = (lanes >> DeviceWarp::lane() & 1) != 0 && queries_.contains(own.i);
    const std::uint32_t having = __ballot_sync(DeviceWarp::all, keeps);
    if (answer_.pairs != nullptr) {
      if (kept_ + __popc(having) > room) store_of_warp();
      if (keeps) pairs()[kept_ + __popc(having & DeviceWarp::lanes_before())] = own;
    }
    kept_ += __popc(having);
  }
  __device__ void count(std::uint32_t i, std::uint32_t more) const {
    if (answer_.count != nullptr && queries_.contains(i)) atomicAdd(answer_.count + i, more);
  }
  /// True when another block had answered Want::any when this one began; the same for all of its threads.
  __device__ bool satisfied() const { return shared_.satisfied; }

  /// Brings what was gathered to the answer; last, by all threads of the block together.
  __device__ void finish() {
    const std::uint32_t warp = threadIdx.x / DeviceWarp::lanes;
    if (DeviceWarp::lane() == 0) shared_.kept[warp] = kept_;
    __syncthreads();
    std::uint32_t before = 0, all = 0;
    for (std::uint32_t w = 0; w < warps; ++w) {
      before += w < warp ? shared_.kept[w] : 0;
      all += shared_.kept[w];
    }
    if (all == 0) return;
    if (threadIdx.x == 0)
      shared_.first = atomicAdd(&answer_.state->found, static_cast<unsigned long long>(all));
    if (answer_.pairs == nullptr) return;
    __syncthreads();
    store(shared_.first + before);
  }

 private:
  __device__ Pair* pairs() const { return shared_.pairs[threadIdx.x / DeviceWarp::lanes]; }

  __device__ void store_of_warp() {
    __syncwarp();
    unsigned long long first = 0;
    if (DeviceWarp::lane() == 0)
      first = atomicAdd(&answer_.state->found, static_cast<unsigned long long>(kept_));
    store(__shfl_sync(DeviceWarp::all, first, 0));
    kept_ = 0;
    __syncwarp();
  }
  /// What this warp kept, from that place of the answer on.
  __device__ void store(unsigned long long first) const {
    for (std::uint32_t k = DeviceWarp::lane(); k < kept_; k += DeviceWarp::lanes) {
      if (first + k < answer_.capacity)
        store_pair(answer_.pairs + first + k, pairs()[k].i, pairs()[k].j);
      else
        answer_.state->overflow = 1;
    }
  }

  Shared& shared_;
  const ResidentAnswer& answer_;
  const SphereRange queries_;
  std::uint32_t kept_ = 0;  ///< the same for all threads of a warp
};

}  // namespace catena::cuda

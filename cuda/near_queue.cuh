#pragma once
#include "catena/cuda/pair_stage.cuh"

namespace catena::cuda {

/// The sink of a CellSearch in a kernel: gathers who is near, to decide it by all threads of the block alike,
/// as threads find very different numbers of them.
class NearQueue {
 public:
  static constexpr std::uint32_t room = 1280;
  struct Shared {
    struct {
      std::uint32_t place, at, level;
    } near[room];
    std::uint32_t used;
    PairStage::Shared pairs;
  };

  /// By all threads of the block, which then synchronize.
  __device__ NearQueue(Shared& shared, const ResidentAnswer& answer, SphereRange queries)
      : shared_(shared), pairs_(shared.pairs, answer, queries) {
    if (threadIdx.x == 0) shared_.used = 0;
  }

  template <class Search>
  __device__ void near(const Search& search, std::uint32_t place, std::uint32_t at, std::uint32_t level) {
    const std::uint32_t k = atomicAdd(&shared_.used, 1u);
    if (k < room)
      shared_.near[k] = {place, at, level};
    else
      search.decide(place, at, level);
  }
  __device__ void pair(std::uint32_t i, std::uint32_t j) { pairs_.pair(i, j); }
  __device__ bool satisfied() const { return pairs_.satisfied(); }
  /// These two by all threads of a warp together.
  __device__ void converge() const { __syncwarp(); }
  __device__ bool any(bool own) const { return __any_sync(0xFFFFFFFFu, own); }

  /// Decides what was gathered and brings what collides to the answer. By all threads of the block together.
  template <class Search>
  __device__ void flush(const Search& search) {
    __syncthreads();
    const std::uint32_t queued = min(shared_.used, room);
    for (std::uint32_t k = threadIdx.x; k < queued; k += blockDim.x)
      search.decide(shared_.near[k].place, shared_.near[k].at, shared_.near[k].level);
    __syncthreads();
    if (threadIdx.x == 0) shared_.used = 0;
    pairs_.flush();  // with a barrier
  }

 private:
  Shared& shared_;
  PairStage pairs_;
};

}  // namespace catena::cuda

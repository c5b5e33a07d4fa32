#pragma once
#include <cstdint>

#include "catena/core/strategy/request.h"
#include "catena/core/strategy/resident.h"
#include "catena/cuda/device_warp.cuh"

namespace catena::cuda {

/// Where the threads of a block gather pairs, each met once, before they go to the answer: one atomic
/// operation on the answer's number for all of them. What finds no room here goes there at once.
template <std::uint32_t threads>
class PairStage {
 public:
  static constexpr std::uint32_t room = 8 * threads;
  struct Shared {
    Pair pairs[room];
    std::uint32_t used;        ///< pairs that came, those without room too, and those only to be counted
    unsigned long long first;  ///< place in the answer of the first
    bool satisfied;
  };

  /// By all threads of the block, which then synchronize.
  __device__ PairStage(Shared& shared, const ResidentAnswer& answer, SphereRange queries)
      : shared_(shared), answer_(answer), queries_(queries) {
    if (threadIdx.x == 0) {
      shared_.used = 0;
      shared_.satisfied = found_already();
    }
  }

  /// By any thread: counts and keeps i < j.
  __device__ void pair(std::uint32_t i, std::uint32_t j) {
    count(i, 1);
    count(j, 1);
    if (queries_.contains(i)) keep(atomicAdd(&shared_.used, 1u), i, j);
  }

  __device__ void count(std::uint32_t i, std::uint32_t more) const {
    if (answer_.count != nullptr && queries_.contains(i)) atomicAdd(answer_.count + i, more);
  }
  /// True when another block had answered Want::any when this one began; the same for all of its threads.
  __device__ bool satisfied() const { return shared_.satisfied; }

  /// Brings what was gathered to the answer, and looks anew whether that is satisfied. By all threads of the
  /// block together.
  __device__ void flush() {
    __syncthreads();
    const std::uint32_t came = shared_.used;
    if (threadIdx.x == 0) shared_.satisfied = found_already();
    // Nobody goes on to use the stage before all know what came.
    if (!__syncthreads_or(came != 0)) return;
    const bool to_keep = answer_.pairs != nullptr;
    if (threadIdx.x == 0) {
      // What found no room was told to the answer already.
      const std::uint32_t told = to_keep ? min(came, room) : came;
      shared_.first = atomicAdd(&answer_.state->found, static_cast<unsigned long long>(told));
      shared_.used = 0;
    }
    __syncthreads();
    if (to_keep)
      for (std::uint32_t k = threadIdx.x; k < min(came, room); k += blockDim.x)
        store(shared_.first + k, shared_.pairs[k]);
    __syncthreads();
  }

 private:
  __device__ bool found_already() const {
    return answer_.count == nullptr && answer_.pairs == nullptr &&
           *static_cast<volatile unsigned long long*>(&answer_.state->found) > 0;
  }

  __device__ void keep(std::uint32_t at, std::uint32_t i, std::uint32_t j) {
    if (answer_.pairs == nullptr) return;
    if (at < room)
      shared_.pairs[at] = {i, j};
    else
      store(atomicAdd(&answer_.state->found, 1ull), {i, j});
  }
  __device__ void store(unsigned long long place, const Pair& pair) const {
    if (place < answer_.capacity)
      answer_.pairs[place] = pair;
    else
      answer_.state->overflow = 1;
  }

  Shared& shared_;
  const ResidentAnswer& answer_;
  const SphereRange queries_;
};

}  // namespace catena::cuda

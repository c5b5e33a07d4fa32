#pragma once
#include <cstdint>

#include "catena/core/strategy/request.h"
#include "catena/core/strategy/resident.h"

namespace catena::cuda {

/// Where the threads of a block gather pairs, each met once, before they go to the answer: one atomic
/// operation on the answer's number for all of them. What finds no room here goes there at once.
class PairStage {
 public:
  static constexpr std::uint32_t room = 1024;
  struct Shared {
    Pair pairs[room];
    std::uint32_t used;        ///< pairs that came, those without room too
    std::uint32_t counted;     ///< pairs that were only to be counted
    unsigned long long first;  ///< place in the answer of the first
  };

  /// By all threads of the block, which then synchronize.
  __device__ PairStage(Shared& shared, const ResidentAnswer& answer, SphereRange queries)
      : shared_(shared), answer_(answer), queries_(queries) {
    if (threadIdx.x == 0) shared_.used = shared_.counted = 0;
  }

  __device__ void pair(std::uint32_t i, std::uint32_t j) {
    const bool of_i = queries_.contains(i);
    if (answer_.count != nullptr) {
      if (of_i) atomicAdd(answer_.count + i, 1u);
      if (queries_.contains(j)) atomicAdd(answer_.count + j, 1u);
    }
    if (!of_i) return;
    came_ = true;
    if (answer_.pairs == nullptr) {
      atomicAdd(&shared_.counted, 1u);
      return;
    }
    const std::uint32_t at = atomicAdd(&shared_.used, 1u);
    if (at < room)
      shared_.pairs[at] = {i, j};
    else
      store(atomicAdd(&answer_.state->found, 1ull), {i, j});
  }

  /// True when another block has answered Want::any already.
  __device__ bool satisfied() const {
    return answer_.count == nullptr && answer_.pairs == nullptr &&
           *static_cast<volatile unsigned long long*>(&answer_.state->found) > 0;
  }

  /// Brings what was gathered to the answer. By all threads of the block together.
  __device__ void flush() {
    if (!__syncthreads_or(came_)) return;
    came_ = false;
    const std::uint32_t staged = min(shared_.used, room), counted = shared_.counted;
    __syncthreads();
    if (threadIdx.x == 0) {
      shared_.first = atomicAdd(&answer_.state->found, static_cast<unsigned long long>(staged + counted));
      shared_.used = shared_.counted = 0;
    }
    __syncthreads();
    for (std::uint32_t k = threadIdx.x; k < staged; k += blockDim.x)
      store(shared_.first + k, shared_.pairs[k]);
    __syncthreads();
  }

 private:
  __device__ void store(unsigned long long place, const Pair& pair) const {
    if (place < answer_.capacity)
      answer_.pairs[place] = pair;
    else
      answer_.state->overflow = 1;
  }

  Shared& shared_;
  const ResidentAnswer& answer_;
  const SphereRange queries_;
  bool came_ = false;  ///< a pair of this thread, since the last flush
};

}  // namespace catena::cuda

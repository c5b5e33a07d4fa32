#pragma once
#include <cstdint>

#include "catena/cuda/device_warp.cuh"

namespace catena::cuda {

/// Which of `count` things a thread takes, in rounds of its block. *Spread*, where there are few enough of
/// them for one round, the threads of a warp take theirs from eight places far apart: the work of a crowd,
/// which lies together, is shared out among many warps. Else they take 32 that follow one another, which ask
/// for the same memory.
class Share {
 public:
  __device__ Share(std::uint32_t count, bool spread)
      : count_(count), spread_(spread && count <= std::uint64_t{gridDim.x} * blockDim.x) {}
  /// The same for all threads of the block.
  __device__ bool any(std::uint32_t round) const {
    return spread_ ? round == 0 : first_of_block(round) < count_;
  }
  /// count or more: nothing in this round.
  __device__ std::uint64_t at(std::uint32_t round) const {
    if (!spread_) return first_of_block(round) + threadIdx.x;
    const std::uint32_t lane = threadIdx.x % DeviceWarp::lanes, block_warps = blockDim.x / DeviceWarp::lanes,
                        warp = blockIdx.x * block_warps + threadIdx.x / DeviceWarp::lanes;
    return (std::uint64_t{lane / together} * gridDim.x * block_warps + warp) * together + lane % together;
  }

 private:
  static constexpr std::uint32_t together = 4;
  __device__ std::uint64_t first_of_block(std::uint32_t round) const {
    return (std::uint64_t{round} * gridDim.x + blockIdx.x) * blockDim.x;
  }
  const std::uint32_t count_;
  const bool spread_;
};

}  // namespace catena::cuda

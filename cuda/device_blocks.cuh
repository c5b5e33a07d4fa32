#pragma once
#include <algorithm>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/cells/first_look.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/cuda/clear_by_block.cuh"
#include "catena/cuda/device_buckets.cuh"
#include "catena/cuda/device_group.cuh"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// Spheres that a warp shares, from the first on; one place in nine is left free, so that threads which read
/// eight apart find them in different banks.
struct WarpSpheres {
  static constexpr std::uint32_t blocks = DeviceWarp::lanes / DeviceQuad::lanes, count = 32 * (blocks + 1);
  Sphere sphere[count + count / 8];
  __device__ static std::uint32_t slot(std::uint32_t k) { return k + k / 8; }
};

constexpr unsigned enclosing_threads = 128;

/// Four threads a block of spheres; the first kernel, which clears the state of all of them too. Its first thread
/// blocks take a look at some blocks meanwhile.
template <class State>
__global__ void __launch_bounds__(enclosing_threads)
    enclose_blocks(const __grid_constant__ ChainView chain, const __grid_constant__ CapsuleBlocks blocks,
                   State* state, std::uint32_t looking) {
  constexpr unsigned warps = enclosing_threads / 32;
  __shared__ union Memory {
    WarpSpheres of_warp[warps];
    FirstLook::Memory of_look;
  } shared;
  if (blockIdx.x == 0) clear_by_block(state);
  if (blockIdx.x < looking) return FirstLook(chain, blocks, shared.of_look).look(DeviceGroup(), blockIdx.x);
  WarpSpheres& own = shared.of_warp[threadIdx.x / 32];
  const std::uint32_t first = ((blockIdx.x - looking) * warps + threadIdx.x / 32) * WarpSpheres::blocks;
  constexpr std::uint32_t share = WarpSpheres::count / DeviceWarp::lanes;
  Sphere mine[share];  // all on their way before the first is waited for
#pragma unroll
  for (std::uint32_t k = 0; k < share; ++k)
    mine[k] = chain.spheres[min(first * CapsuleBlocks::block + k * DeviceWarp::lanes + DeviceWarp::lane(),
                                chain.size - 1)];
#pragma unroll
  for (std::uint32_t k = 0; k < share; ++k)
    own.sphere[WarpSpheres::slot(k * DeviceWarp::lanes + DeviceWarp::lane())] = blocks.scaled(mine[k]);
  __syncwarp();
  const std::uint32_t of_warp = DeviceWarp::lane() / DeviceQuad::lanes;
  const Sphere* const begin = own.sphere + WarpSpheres::slot(of_warp * CapsuleBlocks::block);
  const auto at = [begin](std::uint32_t k) { return begin[WarpSpheres::slot(k)]; };
  BlockMeeting(blocks).enclose(DeviceQuad(), at, first + of_warp);
}

/// A CapsuleBlocks on a device: its memory, and its first step.
class DeviceBlocks {
 public:
  /// Blocks as they are laid out, with memory but for what only partners and cells need; `state` is theirs.
  CapsuleBlocks reserve(CapsuleBlocks blocks, CapsuleBlocks::State* state, cudaStream_t stream) {
    const std::size_t n = blocks.blocks;
    blocks.capsule = capsule_.reserve(n, stream);
    blocks.shape = shape_.reserve(n, stream);
    blocks.partners = partners_.reserve(n, stream);
    blocks.met = met_.reserve(n, stream);
    blocks.state = state;
    if (FirstLook::pays(blocks)) {
      if (look_.capacity() == 0)  // between builds it is 0
        CATENA_CUDA(cudaMemsetAsync(look_.reserve(1, stream), 0, sizeof *blocks.look, stream));
      blocks.look = look_.data();
    }
    return blocks;
  }
  /// The rest.
  void reserve_cells(CapsuleBlocks& blocks, cudaStream_t stream) {
    const std::size_t n = blocks.blocks;
    blocks.ball = ball_.reserve(n, stream);
    blocks.id = id_.reserve(n, stream);
    const std::size_t room = CapsuleBlocks::most_partners * n;
    if (room > partner_.capacity())  // so that lists which are not full are copied whole
      CATENA_CUDA(cudaMemsetAsync(partner_.reserve(room, stream), 0, room * sizeof(std::uint32_t), stream));
    blocks.partner = partner_.data();
    blocks.buckets = buckets_.reserve(blocks.table, n, &blocks.state->places, stream);
  }
  /// `state` holds that of the blocks, and more that is to be cleared.
  template <class State>
  static void enqueue_enclose(const ChainView& chain, const CapsuleBlocks& blocks, State* state,
                              cudaStream_t stream) {
    constexpr std::uint32_t together = enclosing_threads / 32 * WarpSpheres::blocks;
    const std::uint32_t looking = FirstLook::groups(blocks);
    launch_blocks(enclose_blocks<State>, looking + (blocks.blocks + together - 1) / together, enclosing_threads,
                  stream, chain, blocks, state, looking);
  }

 private:
  DeviceBuffer<BlockCapsule> capsule_;
  DeviceBuffer<CapsuleBall> ball_;
  DeviceBuffer<std::uint8_t> shape_;
  DeviceBuffer<std::uint32_t> id_, partners_, partner_, met_;
  DeviceBuffer<CapsuleBlocks::Look> look_;
  DeviceBuckets buckets_;
};

}  // namespace catena::cuda

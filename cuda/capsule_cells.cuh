#pragma once
#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/cuda/block_meetings.cuh"
#include "catena/cuda/device_buckets.cuh"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/share.cuh"

namespace catena::cuda {

struct BlockChunks {
  CapsuleBlocks blocks;
  __device__ std::uint32_t operator()() const {
    return blocks.any_in_cells() ? Buckets::chunks(blocks.table) : 0;
  }
  __device__ float* square_sum() const { return nullptr; }
  __device__ std::uint32_t* in_crowds() const { return nullptr; }
};

template <class Blocks>
__global__ void __launch_bounds__(256) enter_blocks(const __grid_constant__ Blocks blocks) {
  await_previous();
  if (!blocks.any_in_cells()) return;
  const BlockMeeting meeting(blocks);
  for_each_of_mine(blocks.blocks, [&](std::uint32_t b) { meeting.enter(b); });
}

template <class Blocks>
__global__ void __launch_bounds__(256) place_blocks(const __grid_constant__ Blocks blocks) {
  await_previous();
  if (!blocks.any_in_cells()) return;
  const BlockMeeting meeting(blocks);
  for_each_of_mine(blocks.blocks, [&](std::uint32_t b) { meeting.place(b); });
}

template <class Blocks>
__global__ void __launch_bounds__(BlockMeetings::threads) meet_blocks(const __grid_constant__ Blocks blocks) {
  __shared__ BlockMeetings::Shared shared;
  await_previous();
  if (blocks.state->levels == 0) return;
  for (std::uint32_t first = blockIdx.x * BlockMeetings::together; first < blocks.blocks;
       first += gridDim.x * BlockMeetings::together)
    BlockMeetings(blocks, shared, first).meet();  // ends with a barrier, as there is a level
}

/// Puts the tangled blocks of which it is known into cells and finds whom they meet, after a kernel that tells
/// of all of them.
inline void enqueue_capsule_cells(const CapsuleBlocks& blocks, cudaStream_t stream) {
  const auto groups = [&blocks](std::uint32_t together) {
    return std::min((blocks.blocks + together - 1) / together, 1056u);  // each loops over its share
  };
  launch_next<enter_blocks<CapsuleBlocks>>(groups(256), 256, stream, blocks);
  launch_next<allocate_buckets<BlockChunks>>(allocate_blocks(Buckets::chunks(blocks.table)), allocate_threads,
                                             stream, blocks.buckets, BlockChunks{blocks});
  launch_next<place_blocks<CapsuleBlocks>>(groups(256), 256, stream, blocks);
  launch_next<meet_blocks<CapsuleBlocks>>(groups(BlockMeetings::together), BlockMeetings::threads, stream,
                                          blocks);
}

}  // namespace catena::cuda

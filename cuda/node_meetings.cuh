#pragma once
#include <algorithm>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/core/cells/survey_blocks.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/device_group.cuh"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/meet_below.cuh"

namespace catena::cuda {

/// The boxes of 32 nodes of a level, and of the four nodes over them; eight threads a node.
__global__ void __launch_bounds__(256)
    fit_nodes(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks,
              std::uint32_t level) {
  await_previous();
  const NodeMeeting meeting(nodes, blocks);
  const DeviceOctet team;
  const auto fit = [&](std::uint32_t at_level, std::uint32_t node) {
    // Teams are in step with others, and come though there is no such node.
    const std::uint32_t last = nodes.count[at_level] - 1;
    const NodeBox box = meeting.fit(team, at_level, min(node, last));
    if (node > last || DeviceOctet::lane() != 0) return;
    nodes.box[nodes.at(at_level, node)] = box;
    nodes.met[nodes.at(at_level, node)] = 0;
  };
  const std::uint32_t of_block = threadIdx.x / DeviceOctet::lanes;
  fit(level, blockIdx.x * 32 + of_block);
  if (level == nodes.top) return;
  __syncthreads();
  if (threadIdx.x < 32) fit(level + 1, blockIdx.x * 4 + of_block);
}

/// Every node of the top against all others, by a thread block, once others have begun to ask the blocks of
/// the survey. One that is not crowded lists all its meetings, and one that is lists none: of two that are
/// crowded nobody does. One without room for all of its own becomes crowded.
__global__ void __launch_bounds__(512)
    meet_at_top(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  if (blockIdx.x < blocks.surveyed) {
    __shared__ BlockSurvey::Memory memory;
    return BlockSurvey(nodes, blocks, memory).ask(DeviceGroup(), blockIdx.x);
  }
  constexpr std::uint32_t most = BlockNodes::most_crowd_at_top;
  __shared__ std::uint32_t met, first, partner[most];
  __shared__ bool lists;
  if (threadIdx.x == 0) met = 0;
  __syncthreads();
  const NodeMeeting meeting(nodes, blocks);
  const std::uint32_t count = nodes.count[nodes.top], a = blockIdx.x - blocks.surveyed;
  for (std::uint32_t b = threadIdx.x; b < count; b += blockDim.x)
    if (b != a && meeting.may_meet_at_top(a, b)) {
      const std::uint32_t k = atomicAdd(&met, 1u);
      if (k < most) partner[k] = b;
    }
  __syncthreads();
  if (threadIdx.x == 0) {
    const std::uint32_t crowd = nodes.crowd(nodes.top);
    first = nodes.capacity;
    if (met <= crowd) first = atomicAdd(&nodes.state->meetings[nodes.top], met);
    lists = met <= crowd && met <= nodes.capacity && first <= nodes.capacity - met;
    nodes.met[nodes.at(nodes.top, a)] = lists ? met : crowd + 1;
    if (!lists) set_bits(&nodes.state->tangled, 1);
  }
  __syncthreads();
  // What a node without room for all has room for is left out by whoever reads it.
  constexpr std::uint32_t mark = BlockNodes::below_tangled;
  if (threadIdx.x < met && first + threadIdx.x < nodes.capacity)
    nodes.meeting[nodes.top % 2][first + threadIdx.x] =
        lists ? BlockNodes::Meeting{a, partner[threadIdx.x]} : BlockNodes::Meeting{a | mark, a | mark};
}

/// Puts the tangled blocks into their cells.
__global__ void __launch_bounds__(256)
    enter_tangled(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  if (blocks.all_left() || (nodes.state->tangled == 0 && blocks.state->any == 0)) return;
  const BlockMeeting meeting(blocks);
  for (std::uint32_t b = blockIdx.x * blockDim.x + threadIdx.x; b < blocks.blocks;
       b += gridDim.x * blockDim.x)
    meeting.enter(b, nodes.tangled(0, b));
}

/// A BlockNodes on a device: its memory, and its steps as kernels, none of which the host waits for.
class DeviceBlockNodes {
 public:
  /// Finds who meets whom among blocks whose capsules are known, and enters those that are tangled. `state`
  /// is 0 when the work begins.
  void enqueue(const CapsuleBlocks& blocks, std::uint32_t meetings, BlockNodes::State* state,
               cudaStream_t stream) {
    BlockNodes nodes = BlockNodes::over(blocks.blocks, meetings);
    nodes.box = box_.reserve(nodes.nodes(), stream);
    nodes.met = met_.reserve(nodes.nodes(), stream);
    for (int k = 0; k < 2; ++k) nodes.meeting[k] = meeting_[k].reserve(nodes.capacity, stream);
    nodes.state = state;
    for (std::uint32_t level = 1; level <= nodes.top; level += 2)
      launch_next<fit_nodes>((nodes.count[level] + 31) / 32, 256, stream, nodes, blocks, level);
    launch_next<meet_at_top>(nodes.count[nodes.top] + blocks.surveyed, 512, stream, nodes, blocks);
    for (std::uint32_t level = nodes.top; level > 0; --level)
      launch_next<meet_below>(std::min(nodes.count[level] * 2, most_blocks), 128, stream, nodes, blocks,
                              level);
    launch_next<enter_tangled>(std::min((blocks.blocks + 255) / 256, most_blocks), 256, stream, nodes,
                               blocks);
  }

 private:
  static constexpr std::uint32_t most_blocks = 1056;  ///< of a kernel: each loops over its share
  DeviceBuffer<NodeBox> box_;
  DeviceBuffer<std::uint32_t> met_;
  DeviceBuffer<BlockNodes::Meeting> meeting_[2];
};

}  // namespace catena::cuda

#pragma once
#include <algorithm>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/find_partners.h"
#include "catena/core/cells/first_look.h"
#include "catena/core/cells/survey_blocks.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/device_group.cuh"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// The boxes of 32 nodes of a level, and of the four nodes over them; eight threads a node.
template <class Nodes>
__global__ void __launch_bounds__(256)
    fit_nodes(const __grid_constant__ Nodes nodes, const __grid_constant__ CapsuleBlocks blocks,
              std::uint32_t level) {
  await_previous();
  if (level == 1 && blockIdx.x == 0 && threadIdx.x == 0) FirstLook::tell(blocks);
  if (blocks.left_at_first_look()) return;
  const NodeMeeting meeting(nodes, blocks);
  const DeviceOctet team;
  const auto fit = [&](std::uint32_t at_level, std::uint32_t node) {
    // Teams are in step with others, and come though there is no such node.
    const std::uint32_t last = nodes.count[at_level] - 1;
    const NodeBox box = meeting.fit(team, at_level, min(node, last));
    if (node <= last && DeviceOctet::lane() == 0) nodes.put(at_level, node, box);
  };
  const std::uint32_t of_block = threadIdx.x / DeviceOctet::lanes;
  fit(level, blockIdx.x * 32 + of_block);
  if (level == nodes.top) return;
  __syncthreads();
  if (threadIdx.x < 32) fit(level + 1, blockIdx.x * 4 + of_block);
}

/// Whom the blocks of a node of level 2 meet, by a thread block, once others have begun to ask the blocks of
/// the survey.
template <unsigned threads>
__global__ void __launch_bounds__(threads, 1280 / threads)
    find_partners(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks) {
  __shared__ union Memory {
    BlockSurvey::Memory survey;
    PartnerSearch::Memory search;
  } memory;
  await_previous();
  if (blockIdx.x == 0 && threadIdx.x == 0) FirstLook::forget(blocks);
  if (blockIdx.x < blocks.surveyed) {
    if (!blocks.surveyed_all()) BlockSurvey(nodes, blocks, memory.survey).ask(DeviceGroup(), blockIdx.x);
  } else {
    PartnerSearch(nodes, blocks, memory.search).find(DeviceGroup(), blockIdx.x - blocks.surveyed);
  }
}

/// A BlockNodes on a device: its memory, and its steps as kernels, none of which the host waits for.
class DeviceBlockNodes {
 public:
  /// Fits boxes over blocks whose capsules are known, of which there is one.
  void enqueue_fit(const CapsuleBlocks& blocks, std::uint32_t at_top, cudaStream_t stream) {
    nodes_ = BlockNodes::over(blocks.blocks, at_top);
    nodes_.quarter = quarter_.reserve(BlockNodes::quarters * std::size_t{nodes_.nodes()}, stream);
    for (std::uint32_t level = 1; level <= nodes_.top; level += 2)
      launch_next<fit_nodes<BlockNodes>>((nodes_.count[level] + 31) / 32, 256, stream, nodes_, blocks, level);
  }
  /// The same, and finds who meets whom, and enters those that are tangled.
  void enqueue(const CapsuleBlocks& blocks, cudaStream_t stream) {
    enqueue_fit(blocks, BlockNodes::most_at_top, stream);
    const BlockNodes& nodes = nodes_;
    const std::uint32_t groups = blocks.surveyed + nodes.count[2];
    constexpr std::uint32_t few = 660;  // have places at once
    if (groups <= few)
      launch_next<find_partners<256>>(groups, 256, stream, nodes, blocks);
    else
      launch_next<find_partners<128>>(groups, 128, stream, nodes, blocks);
  }
  const BlockNodes& nodes() const { return nodes_; }

 private:
  BlockNodes nodes_{};
  DeviceBuffer<BlockNodes::Quarter> quarter_;
};

}  // namespace catena::cuda

#pragma once
#include <algorithm>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/launch.cuh"

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

/// Meetings of one level on their way to its list.
class MeetingList {
 public:
  __device__ MeetingList(const BlockNodes& nodes, const NodeMeeting& meeting, std::uint32_t level)
      : nodes_(nodes), meeting_(meeting), level_(level) {}

  /// By all threads of a warp together: of those that met somebody.
  __device__ void add(bool met, std::uint32_t a, std::uint32_t b, std::uint32_t marks_a,
                      std::uint32_t marks_b) const {
    met = met && meeting_.note(level_, a, b);
    const std::uint32_t all = __ballot_sync(DeviceWarp::all, met);
    if (all == 0) return;
    std::uint32_t first = 0;
    if (DeviceWarp::lane() == 0) first = atomicAdd(&nodes_.state->meetings[level_], __popc(all));
    const std::uint32_t k =
        __shfl_sync(DeviceWarp::all, first, 0) + __popc(all & DeviceWarp::lanes_before());
    if (!met) return;
    if (k < nodes_.capacity)
      nodes_.meeting[level_ % 2][k] = {a | marks_a, b | marks_b};
    else
      meeting_.give_up(level_, a, b);
  }

 private:
  const BlockNodes& nodes_;
  const NodeMeeting& meeting_;
  const std::uint32_t level_;
};

/// Every node of the top against all others, by a thread block. One that is not crowded lists all its
/// meetings, and one that is lists none: of two that are crowded nobody does. One without room for all of its
/// own becomes crowded.
__global__ void __launch_bounds__(512)
    meet_at_top(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  constexpr std::uint32_t most = BlockNodes::most_crowd_at_top;
  __shared__ std::uint32_t met, first, partner[most];
  __shared__ bool lists;
  if (threadIdx.x == 0) met = 0;
  __syncthreads();
  const NodeMeeting meeting(nodes, blocks);
  const std::uint32_t count = nodes.count[nodes.top], a = blockIdx.x;
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

/// The children of nodes of a level that met one another, and of each of its nodes among themselves; sixteen
/// threads for two nodes.
__global__ void __launch_bounds__(128)
    meet_below(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks,
               std::uint32_t level) {
  constexpr std::uint32_t children = BlockNodes::children, mark = BlockNodes::below_tangled;
  await_previous();
  const NodeMeeting meeting(nodes, blocks);
  const BlockMeeting of_blocks(blocks);
  const MeetingList list(nodes, meeting, level - 1);
  const std::uint32_t half = DeviceWarp::lane() / 16, s = DeviceWarp::lane() % 16, own = nodes.count[level],
                      all = own + nodes.meetings(level), warps = gridDim.x * blockDim.x / 32;
  for (std::uint32_t from = (blockIdx.x * blockDim.x + threadIdx.x) / 32 * 2; from < all; from += 2 * warps) {
    const std::uint32_t item = from + half;
    const bool self = item < own;
    BlockNodes::Meeting of{item, item};
    bool live = item < all;
    if (live && !self) of = nodes.meeting[level % 2][item - own];
    if (live) live = self ? !meeting.settled(level, item) : !meeting.leaves_out(level, of);
    const std::uint32_t a = of.a & ~mark, b = of.b & ~mark, marks_a = of.a & mark, marks_b = of.b & mark;
    // Children that the other node may hold: eight threads for a's, eight for b's.
    std::uint32_t of_a = 0;
    if (live) {
      const std::uint32_t node = s < children ? a : b, k = s % children;
      const bool exists = (nodes.children_of(level, node) >> k & 1) != 0;
      of_a = exists && (self || meeting.may_hold(level - 1, s < children ? b : a, node * children + k));
    }
    const std::uint32_t held = __ballot_sync(DeviceWarp::all, of_a != 0) >> half * 16 & 0xFFFF;
    const std::uint32_t of_b = held >> children;
    std::uint32_t left = of_b != 0 ? held & 0xFF : 0;
    while (__any_sync(DeviceWarp::all, left != 0)) {
      const std::uint32_t second = left & (left - 1), mine = s < children ? left : second;
      const std::uint32_t i = mine != 0 ? lowest_bit(mine) : 0, j = s % children;
      left = second & (second - 1);
      const std::uint32_t child_a = a * children + i, child_b = b * children + j;
      const bool met = mine != 0 && (of_b >> j & 1) != 0 && (!self || i < j) &&
                       meeting.may_meet(level - 1, child_a, child_b);
      if (level > 1)
        list.add(met, child_a, child_b, marks_a, marks_b);
      else if (met)
        of_blocks.note_mutual(child_a, child_b);
    }
  }
}

/// Puts the tangled blocks into their cells.
__global__ void __launch_bounds__(256)
    enter_tangled(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks) {
  await_previous();
  if (nodes.state->tangled == 0 && blocks.state->any == 0) return;
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
    launch_next<meet_at_top>(nodes.count[nodes.top], 512, stream, nodes, blocks);
    for (std::uint32_t level = nodes.top; level > 0; --level)
      launch_next<meet_below>(std::min(nodes.count[level] * 2, most_blocks_below), 128, stream, nodes, blocks,
                              level);
    launch_next<enter_tangled>(std::min((blocks.blocks + 255) / 256, most_blocks), 256, stream, nodes,
                               blocks);
  }

 private:
  static constexpr std::uint32_t most_blocks = 1056;        ///< of a kernel: each loops over its share
  static constexpr std::uint32_t most_blocks_below = 2112;  ///< more, as some shares are much larger
  DeviceBuffer<NodeBox> box_;
  DeviceBuffer<std::uint32_t> met_;
  DeviceBuffer<BlockNodes::Meeting> meeting_[2];
};

}  // namespace catena::cuda

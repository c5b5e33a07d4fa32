#pragma once
#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// Two nodes of a level, or blocks, that may meet or do, on their way through a warp's memory: each step
/// takes as many at a time as there are threads, however few a node has.
class PairQueue {
 public:
  static constexpr std::uint32_t lanes = DeviceWarp::lanes, room = 2 * 64 + lanes;
  using Meeting = BlockNodes::Meeting;

  __device__ explicit PairQueue(Meeting* memory) : memory_(memory) {}

  /// These by all threads of a warp together. A thread's own, where it has one.
  __device__ void add(bool has, const Meeting& own) {
    const std::uint32_t having = __ballot_sync(DeviceWarp::all, has);
    if (has) memory_[used_ + __popc(having & DeviceWarp::lanes_before())] = own;
    used_ += __popc(having);
    __syncwarp();
  }
  /// Room for so many more, to be written by whoever has them.
  __device__ Meeting* add_some(std::uint32_t more) {
    Meeting* const to = memory_ + used_;
    used_ += more;
    return to;
  }
  /// use(has, pair) of the last ones while there are enough for all threads, or any if `all`.
  template <class Use>
  __device__ void take(bool all, const Use& use) {
    while (used_ >= lanes || (all && used_ > 0)) {
      const std::uint32_t taken = min(used_, lanes), lane = DeviceWarp::lane();
      used_ -= taken;
      const bool has = lane < taken;
      const Meeting own = has ? memory_[used_ + lane] : Meeting{0, 0};
      __syncwarp();
      use(has, own);
    }
  }

 private:
  Meeting* const memory_;
  std::uint32_t used_ = 0;  ///< the same for all threads
};

/// The children of nodes of a level that met one another, and of each of its nodes among themselves. Sixteen
/// threads find which children of two nodes the other one may hold; what is left of their pairs is compared,
/// and told, by all threads alike.
class MeetBelow {
 public:
  static constexpr std::uint32_t threads = 128, warps = threads / DeviceWarp::lanes;
  struct Shared {
    struct Warp {
      BlockNodes::Meeting may[PairQueue::room], meet[2 * PairQueue::lanes];
      std::uint32_t held[4][BlockNodes::children];  ///< children that may be met, of two times two nodes
    } warp[warps];
  };

  __device__ MeetBelow(const BlockNodes& nodes, const CapsuleBlocks& blocks, std::uint32_t level,
                       Shared& shared)
      : nodes_(nodes),
        level_(level),
        meeting_(nodes, blocks),
        of_blocks_(blocks),
        held_(shared.warp[threadIdx.x / DeviceWarp::lanes].held),
        may_meet_(shared.warp[threadIdx.x / DeviceWarp::lanes].may),
        meets_(shared.warp[threadIdx.x / DeviceWarp::lanes].meet) {}

  /// By all threads of a warp together: nodes in two of the places from `from` on, of which first those of
  /// the level's nodes and then those of its meetings.
  __device__ void look_at_two(std::uint32_t from, std::uint32_t all) {
    const std::uint32_t half = DeviceWarp::lane() / 16, s = DeviceWarp::lane() % 16, side = s / children;
    const std::uint32_t own = nodes_.count[level_], item = from + half;
    const bool self = item < own;
    Meeting of{item, item};
    bool live = item < all;
    if (live && !self) of = nodes_.meeting[level_ % 2][item - own];
    if (live) live = self ? !meeting_.settled(level_, item) : !meeting_.leaves_out(level_, of);
    const std::uint32_t a = of.a & ~mark, b = of.b & ~mark;
    bool may = false;
    if (live) {
      const std::uint32_t node = side == 0 ? a : b, k = s % children;
      const bool exists = (nodes_.children_of(level_, node) >> k & 1) != 0;
      may = exists && (self || meeting_.may_hold(level_ - 1, side == 0 ? b : a, node * children + k));
    }
    const std::uint32_t bits = __ballot_sync(DeviceWarp::all, may),
                        of_side = bits >> (DeviceWarp::lane() & ~7u) & 0xFF,
                        before = of_side & ((1u << s % children) - 1);
    if (may)
      held_[2 * half + side][__popc(before)] =
          ((side == 0 ? of.a : of.b) & mark) | ((side == 0 ? a : b) * children + s % children);
    const std::uint32_t of_a = __popc(bits >> half * 16 & 0xFF),
                        of_b = __popc(bits >> (half * 16 + 8) & 0xFF);
    const bool each_once = self && of_a == children;
    const std::uint32_t pairs = each_once ? children * (children - 1) / 2 : of_a * of_b,
                        of_first = __shfl_sync(DeviceWarp::all, pairs, 0);
    Meeting* const to =
        may_meet_.add_some(of_first + __shfl_sync(DeviceWarp::all, pairs, 16)) + (half == 0 ? 0 : of_first);
    __syncwarp();
    const std::uint32_t over = of_b != 0 ? 65536 / of_b + 1 : 0;  // k over / 65536 is k / of_b, for k < 64
    for (std::uint32_t k = s; k < pairs; k += 16) {
      std::uint32_t i = k * over >> 16, j = k - i * of_b;
      if (each_once) {  // the one, two and three further on, in a circle, and half of those across
        const std::uint32_t one = k % children, other = (one + 1 + i) % children;
        i = min(one, other), j = max(one, other);
      }
      to[k] = {held_[2 * half][i], held_[2 * half + 1][j]};
    }
    __syncwarp();
  }

  /// Compares what was found, as far as there is work for all threads, or all of it.
  __device__ void compare(bool all) {
    may_meet_.take(all, [&](bool has, const Meeting& of) {
      const std::uint32_t a = of.a & ~mark, b = of.b & ~mark;
      // Of a node with fewer than all children they stand in the list both ways.
      const bool once = a / children != b / children || a < b;
      meets_.add(has && once && meeting_.may_meet(level_ - 1, a, b), of);
      meets_.take(false, [&](bool meets, const Meeting& two) { tell(meets, two); });
    });
    if (all) meets_.take(true, [&](bool meets, const Meeting& two) { tell(meets, two); });
  }

 private:
  using Meeting = BlockNodes::Meeting;
  static constexpr std::uint32_t children = BlockNodes::children, mark = BlockNodes::below_tangled;

  __device__ void tell(bool met, const Meeting& of) const {
    const std::uint32_t a = of.a & ~mark, b = of.b & ~mark, below = level_ - 1;
    if (below == 0) {
      if (met) of_blocks_.note_mutual(a, b);
      return;
    }
    const bool listed = met && meeting_.note(below, a, b);
    const std::uint32_t all = __ballot_sync(DeviceWarp::all, listed);
    if (all == 0) return;
    std::uint32_t first = 0;
    if (DeviceWarp::lane() == 0) first = atomicAdd(&nodes_.state->meetings[below], __popc(all));
    const std::uint32_t k = __shfl_sync(DeviceWarp::all, first, 0) + __popc(all & DeviceWarp::lanes_before());
    if (!listed) return;
    if (k < nodes_.capacity)
      nodes_.meeting[below % 2][k] = of;
    else
      meeting_.give_up(below, a, b);
  }

  const BlockNodes& nodes_;
  const std::uint32_t level_;
  const NodeMeeting meeting_;
  const BlockMeeting of_blocks_;
  std::uint32_t (&held_)[4][children];
  PairQueue may_meet_, meets_;
};

__global__ void __launch_bounds__(MeetBelow::threads)
    meet_below(const __grid_constant__ BlockNodes nodes, const __grid_constant__ CapsuleBlocks blocks,
               std::uint32_t level) {
  __shared__ MeetBelow::Shared shared;
  await_previous();
  if (blocks.all_left()) return;
  MeetBelow below(nodes, blocks, level, shared);
  const std::uint32_t all = nodes.count[level] + nodes.meetings(level),
                      step = 2 * gridDim.x * MeetBelow::warps;
  for (std::uint32_t from = (blockIdx.x * MeetBelow::warps + threadIdx.x / DeviceWarp::lanes) * 2; from < all;
       from += step) {
    below.look_at_two(from, all);
    below.compare(from + step >= all);
  }
}

}  // namespace catena::cuda

#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/meet_blocks.h"
#include "catena/cuda/device_warp.cuh"

namespace catena::cuda {

/// Whom 32 blocks of spheres meet: first a thread for each of these and each row of cells finds the places to
/// look at, which are looked at by it where they are few, else by a warp for each block, as many at a time as
/// it has threads; and at last all threads alike decide of whom was near.
class BlockMeetings {
 public:
  static constexpr std::uint32_t together = 32, rows = BlockMeeting::rows,
                                 threads = together * rows;  // a row a warp
  struct Shared {
    static constexpr std::uint32_t room = 1024;
    Buckets::Run run[together][rows];
    struct {
      std::uint32_t of, other;
    } near[room];
    std::uint32_t offset[rows][rows];  ///< by warp
    std::uint32_t used, crowded;
  };

  /// For the blocks from `first` on. Threads of one block may go on to others after a barrier.
  __device__ BlockMeetings(const CapsuleBlocks& blocks, Shared& shared, std::uint32_t first)
      : blocks_(blocks), meeting_(blocks), shared_(shared), first_(first) {}

  __device__ void meet() const {
    const std::uint32_t b = first_ + threadIdx.x % together;
    const std::uint32_t own_level = b < blocks_.blocks && blocks_.looks(b) ? blocks_.level(b) : ~0u;
    if (threadIdx.x == 0) shared_.crowded = 0;
    for (std::uint32_t levels = blocks_.state->levels; levels != 0; levels &= levels - 1) {
      const std::uint32_t level = lowest_bit(levels);
      if (threadIdx.x == 0) shared_.used = 0;
      __syncthreads();
      const Buckets::Run run = find_places(b, own_level <= level, level);
      if (!__syncthreads_or(run.end - run.first > few)) {
        for (std::uint32_t at = run.first; at < run.end; ++at)
          if (meeting_.may_meet(b, ball_of(blocks_.capsule[b]), level, at))
            put(atomicAdd(&shared_.used, 1u), b, meeting_.block_at(at));
      } else {
        for (std::uint32_t k = threadIdx.x / 32; k < together; k += rows)
          if ((shared_.crowded >> k & 1) == 0) look(k, level);
      }
      __syncthreads();
      for (std::uint32_t k = threadIdx.x; k < min(shared_.used, Shared::room); k += threads)
        meeting_.note(shared_.near[k].of, shared_.near[k].other);
      __syncthreads();
    }
  }

 private:
  static constexpr std::uint32_t few = 6;

  __device__ Buckets::Run find_places(std::uint32_t b, bool looks, std::uint32_t level) const {
    const std::uint32_t k = threadIdx.x % together, row = threadIdx.x / together;
    CapsuleBlocks::Row rest{0, 0};
    Buckets::Run run{0, 0};
    if (looks) run = meeting_.look(b, level, row, rest);
    bool too_many = BlockMeeting::too_many(run);
    while (rest.cells > 0 && !too_many) {  // seldom
      const Buckets::Run more = meeting_.look_on(rest);
      too_many = BlockMeeting::too_many(more);
      for (std::uint32_t at = more.first; at < more.end && !too_many; ++at)
        if (meeting_.may_meet(b, ball_of(blocks_.capsule[b]), level, at))
          meeting_.note(b, meeting_.block_at(at));
    }
    if (too_many) {
      meeting_.crowd(b);
      atomicOr(&shared_.crowded, 1u << k);
      run = {0, 0};
    }
    shared_.run[k][row] = run;
    return run;
  }

  /// All rows one behind the other, a place a thread.
  __device__ void look(std::uint32_t k, std::uint32_t level) const {
    const std::uint32_t b = first_ + k, lane = DeviceWarp::lane();
    const Buckets::Run own = lane < rows ? shared_.run[k][lane] : Buckets::Run{0, 0};
    const LaneSum places = LaneSum::of(own.end - own.first);
    if (places.all == 0) return;
    const std::uint32_t held = __ballot_sync(DeviceWarp::all, own.first < own.end);
    // Of the rows that hold something, in order, what leads from the number of a place among all to the
    // place.
    std::uint32_t* const offset = shared_.offset[threadIdx.x / 32];
    if (own.first < own.end) offset[__popc(held & DeviceWarp::lanes_before())] = own.first - places.before;
    __syncwarp();
    const CapsuleBall ball = ball_of(blocks_.capsule[b]);
    std::uint32_t begun = 0;  // rows before the places that are looked at now
    for (std::uint32_t from = 0; from < places.all; from += DeviceWarp::lanes) {
      const bool begins = own.first < own.end && places.before - from < DeviceWarp::lanes;
      const std::uint32_t begin = DeviceWarp::bits_of_all(begins ? 1u << (places.before - from) : 0u);
      const std::uint32_t row = begun + __popc(begin & (DeviceWarp::lanes_before() | 1u << lane)) - 1;
      const bool in = from + lane < places.all;
      const std::uint32_t at = offset[in ? row : 0] + from + lane;
      queue(in && meeting_.may_meet(b, ball, level, at), b, at);
      begun += __popc(begin);
    }
    __syncwarp();
  }

  /// By all threads of a warp together.
  __device__ void queue(bool near, std::uint32_t b, std::uint32_t at) const {
    const std::uint32_t all_near = __ballot_sync(DeviceWarp::all, near);
    if (all_near == 0) return;
    std::uint32_t first = 0;
    if (DeviceWarp::lane() == 0) first = atomicAdd(&shared_.used, __popc(all_near));
    const std::uint32_t k =
        __shfl_sync(DeviceWarp::all, first, 0) + __popc(all_near & DeviceWarp::lanes_before());
    if (near) put(k, b, meeting_.block_at(at));
  }
  __device__ void put(std::uint32_t k, std::uint32_t b, std::uint32_t other) const {
    if (k < Shared::room)
      shared_.near[k] = {b, other};
    else
      meeting_.note(b, other);
  }

  const CapsuleBlocks& blocks_;
  const BlockMeeting meeting_;
  Shared& shared_;
  const std::uint32_t first_;
};

}  // namespace catena::cuda

#pragma once
#include "catena/core/cells/search_cells.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/resident.h"
#include "catena/cuda/device_warp.cuh"
#include "catena/cuda/store_pair.cuh"

namespace catena::cuda {

/// The sink of a search in a kernel. Threads find very different numbers of spheres near theirs: each warp
/// gathers these and decides as many at a time as it has threads. What collides stays where it was gathered;
/// only at every second flush do warps wait for one another, to bring pairs to the answer by one atomic
/// operation a block. Each thread asks for one sphere between flushes.
template <std::uint32_t threads>
class NearQueue {
 public:
  static constexpr std::uint32_t warps = threads / DeviceWarp::lanes, room = 12 * DeviceWarp::lanes;
  struct Near {
    std::uint32_t at, who;  ///< who: thread, and level times their number. Later a pair.
  };
  struct Shared {
    struct Warp {
      Near near[room];
      Sphere sphere[DeviceWarp::lanes];  ///< by thread: near whose
      std::uint32_t index[DeviceWarp::lanes];
      std::uint32_t met[DeviceWarp::lanes];  ///< by thread: how many of these collided
    } warp[warps];
    std::uint32_t kept[warps];  ///< pairs of each warp
    unsigned long long first;   ///< place in the answer of the first of these
    unsigned long long found;
  };

  /// By all threads of the block, which then synchronize.
  __device__ NearQueue(Shared& shared, const ResidentAnswer& answer, SphereRange queries)
      : shared_(shared),
        own_(shared.warp[threadIdx.x / DeviceWarp::lanes]),
        answer_(answer),
        queries_(queries),
        counted_(answer.count != nullptr ? queries : SphereRange{0, 0}) {
    own_.met[DeviceWarp::lane()] = 0;
    if (threadIdx.x == 0) shared_.found = 0;
  }

  /// These five by all threads of a warp together. Whose sphere is near those that follow, until the flush.
  __device__ void asks(const PlacedSphere& own) {
    own_.sphere[DeviceWarp::lane()] = own.sphere;
    own_.index[DeviceWarp::lane()] = own.index;
  }
  template <class Search, std::size_t sets>
  __device__ void near(const Search& search, std::uint32_t level, const PlaceSet (&near)[sets]) {
    std::uint32_t mine = 0;
    for (const PlaceSet& set : near) mine += __popc(set.bits);
    const LaneSum sum = LaneSum::of(mine);
    if (sum.all == 0) return;
    if (kept_ + used_ + sum.all > room) return near_in_parts(search, sum, level, near);
    Near* to = own_.near + kept_ + used_ + sum.before;
#pragma unroll
    for (PlaceSet set : near)
      while (set.bits != 0) *to++ = gathered(set.take(), level);
    used_ += sum.all;
    converge();
  }
  template <class Search>
  __device__ void near_one(const Search& search, std::uint32_t level, std::uint32_t at, bool is_near) {
    const std::uint32_t having = __ballot_sync(DeviceWarp::all, is_near);
    if (having == 0) return;
    if (kept_ + used_ + __popc(having) > room) decide_for_room(search);
    if (is_near) own_.near[kept_ + used_ + __popc(having & DeviceWarp::lanes_before())] = gathered(at, level);
    used_ += __popc(having);
    converge();
  }
  __device__ void converge() const { __syncwarp(); }
  __device__ bool any(bool own) const { return __any_sync(DeviceWarp::all, own); }

  /// True when Want::any has its answer; the same for all threads of a warp, which come together, and for the
  /// block where pairs are kept.
  __device__ bool satisfied() const {
    return answer_.count == nullptr && answer_.pairs == nullptr &&
           any(*static_cast<volatile unsigned long long*>(&answer_.state->found) > 0);
  }

  /// Decides what was gathered, and sees to it that what collides gets to the answer. By all threads of the
  /// block together.
  template <class Search>
  __device__ void flush(const Search& search) {
    decide(search);
    std::uint32_t& met = own_.met[DeviceWarp::lane()];
    if (met != 0) {
      count(own_.index[DeviceWarp::lane()], met);
      met = 0;
    }
    if (answer_.pairs == nullptr && answer_.count == nullptr)
      tell_found(&answer_.state->found);  // at once, so that others may leave
    if (answer_.pairs != nullptr && ++flushes_ % 2 == 0) {
      store_of_block();
      __syncthreads();  // as the next ones of each warp may be told before all of these are read
    }
    converge();
  }
  /// After the last flush; by all threads of the block together.
  __device__ void finish() {
    if (answer_.pairs != nullptr) return store_of_block();
    tell_found(&shared_.found);
    __syncthreads();
    if (threadIdx.x == 0 && shared_.found != 0) atomicAdd(&answer_.state->found, shared_.found);
  }

 private:
  __device__ static Near gathered(std::uint32_t at, std::uint32_t level) {
    return {at, DeviceWarp::lane() + level * DeviceWarp::lanes};
  }

  /// Where there is no room for all at once.
  template <class Search, std::size_t sets>
  __device__ void near_in_parts(const Search& search, LaneSum sum, std::uint32_t level,
                                const PlaceSet (&near)[sets]) {
    PlaceSet left[sets];
#pragma unroll
    for (std::size_t s = 0; s < sets; ++s) left[s] = near[s];
    for (;;) {
      decide_for_room(search);
      std::uint32_t k = sum.before;
#pragma unroll
      for (PlaceSet& set : left)
        while (set.bits != 0 && k < room) own_.near[k++] = gathered(set.take(), level);
      used_ = min(sum.all, room);
      converge();
      if (sum.all <= room) return;
      std::uint32_t mine = 0;
#pragma unroll
      for (const PlaceSet& set : left) mine += __popc(set.bits);
      sum = LaneSum::of(mine);
    }
  }
  template <class Search>
  __device__ void decide_for_room(const Search& search) {
    decide(search);
    if (kept_ == 0) return;
    unsigned long long first = 0;
    if (DeviceWarp::lane() == 0)
      first = atomicAdd(&answer_.state->found, static_cast<unsigned long long>(kept_));
    store(__shfl_sync(DeviceWarp::all, first, 0));
  }

  /// Of what was gathered, the pairs that collide: kept in its place, or counted where none are wanted.
  template <class Search>
  __device__ void decide(const Search& search) {
    const Near* const gathered = own_.near + kept_;
    for (std::uint32_t first = 0; first < used_; first += DeviceWarp::lanes) {
      const std::uint32_t k = first + DeviceWarp::lane();
      Pair pair{0, 0};
      bool keeps = false;
      if (k < used_) {
        const Near near = gathered[k];
        const std::uint32_t who = near.who % DeviceWarp::lanes;
        const Met met =
            search.met({own_.sphere[who], own_.index[who]}, near.at, near.who / DeviceWarp::lanes);
        if (met.collide) {
          pair = {min(met.i, met.j), max(met.i, met.j)};
          keeps = queries_.contains(pair.i);
          atomicAdd(own_.met + who, 1u);
          count(met.j, 1);
        }
      }
      if (answer_.pairs != nullptr) {
        const std::uint32_t having = __ballot_sync(DeviceWarp::all, keeps);
        converge();  // what is written over was read
        if (keeps) own_.near[kept_ + __popc(having & DeviceWarp::lanes_before())] = {pair.i, pair.j};
        kept_ += __popc(having);
      } else if (keeps) {
        ++found_;
      }
    }
    used_ = 0;
    converge();
  }
  __device__ void count(std::uint32_t i, std::uint32_t more) const {
    if (counted_.contains(i)) atomicAdd(answer_.count + i, more);
  }

  __device__ void store_of_block() {
    const std::uint32_t warp = threadIdx.x / DeviceWarp::lanes;
    if (DeviceWarp::lane() == 0) shared_.kept[warp] = kept_;
    __syncthreads();
    std::uint32_t before = 0, all = 0;
    for (std::uint32_t w = 0; w < warps; ++w) {
      before += w < warp ? shared_.kept[w] : 0;
      all += shared_.kept[w];
    }
    if (all == 0) return;
    if (threadIdx.x == 0)
      shared_.first = atomicAdd(&answer_.state->found, static_cast<unsigned long long>(all));
    __syncthreads();
    store(shared_.first + before);
  }
  /// What this warp kept, from that place of the answer on.
  __device__ void store(unsigned long long first) {
    for (std::uint32_t k = DeviceWarp::lane(); k < kept_; k += DeviceWarp::lanes) {
      if (first + k < answer_.capacity)
        store_pair(answer_.pairs + first + k, own_.near[k].at, own_.near[k].who);
      else
        answer_.state->overflow = 1;
    }
    kept_ = 0;
    converge();
  }
  __device__ void tell_found(unsigned long long* total) {
    // By halves: what the threads of a warp counted together may need more than 32 bits.
    const LaneSum low = LaneSum::of(found_ & 0xFFFF), high = LaneSum::of(found_ >> 16);
    const unsigned long long all = (static_cast<unsigned long long>(high.all) << 16) + low.all;
    if (DeviceWarp::lane() == 0 && all != 0) atomicAdd(total, all);
    found_ = 0;
  }

  Shared& shared_;
  typename Shared::Warp& own_;
  const ResidentAnswer& answer_;
  const SphereRange queries_;
  const SphereRange counted_;  ///< whose collisions are counted
  // The same for all threads of a warp.
  std::uint32_t kept_ = 0;  ///< pairs, in the place of what was decided
  std::uint32_t used_ = 0;  ///< gathered behind these, and not yet decided
  std::uint32_t flushes_ = 0;
  std::uint32_t found_ = 0;  ///< by thread: pairs that were only counted
};

}  // namespace catena::cuda

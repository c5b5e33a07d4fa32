#pragma once
#include <cstdint>

#include "catena/core/sphere.h"

namespace catena::cuda {

/// A value a lane: each thread holds its own, and asks for no other.
template <class T>
struct OwnLane {
  T own;
  __device__ const T& operator[](std::uint32_t) const { return own; }
};

/// So many threads side by side of a warp that comes whole and together; the host's twin is HostTeam.
template <std::uint32_t count>
struct DeviceTeam {
  static constexpr std::uint32_t lanes = count, all = 0xFFFFFFFFu;
  template <class T>
  using Lanes = OwnLane<T>;

  __device__ static std::uint32_t lane() { return threadIdx.x % lanes; }

  template <class F>
  __device__ auto each(const F& value) const {
    return Lanes<decltype(value(0u))>{value(lane())};
  }
  template <class F>
  __device__ bool none(const F& flag) const {
    const bool own = flag(lane());
    constexpr std::uint32_t of_team = lanes < 32 ? (1u << lanes % 32) - 1 : all;
    return (__ballot_sync(all, own) >> (threadIdx.x % 32 & ~(lanes - 1)) & of_team) == 0;
  }
  template <class F>
  __device__ float greatest(const F& number) const {
    float result = number(lane());
    for (std::uint32_t step = 1; step < lanes; step *= 2)
      result = fmaxf(result, __shfl_xor_sync(all, result, static_cast<int>(step)));
    return result;
  }
  template <class F>
  __device__ float sum(const F& number) const {
    float result = number(lane());
    for (std::uint32_t step = 1; step < lanes; step *= 2)
      result += __shfl_xor_sync(all, result, static_cast<int>(step));
    return result;
  }
};

struct DeviceWarp : DeviceTeam<32> {
  /// A bit for each lane before the calling one.
  __device__ static std::uint32_t lanes_before() { return (1u << lane()) - 1; }
  template <class F>
  __device__ void run(const F& body) const {
    body(lane());
    __syncwarp();
  }
  template <class F>
  __device__ std::uint32_t ballot(const F& flag) const {
    const bool own = flag(lane());
    return __ballot_sync(all, own);
  }
  /// Those that any lane has.
  __device__ static std::uint32_t bits_of_all(std::uint32_t own) {
#if __CUDA_ARCH__ >= 800
    return __reduce_or_sync(all, own);
#else
    for (int step = lanes / 2; step > 0; step /= 2) own |= __shfl_xor_sync(all, own, step);
    return own;
#endif
  }
  __device__ std::uint32_t any(const Lanes<std::uint32_t>& bits) const { return bits_of_all(bits.own); }
  template <class T>
  __device__ T from(const Lanes<T>& value, std::uint32_t lane) const {
    return __shfl_sync(all, value.own, static_cast<int>(lane));
  }
  __device__ Sphere from(const Lanes<Sphere>& value, std::uint32_t lane) const {
    const auto of = static_cast<int>(lane);
    return {__shfl_sync(all, value.own.x, of), __shfl_sync(all, value.own.y, of),
            __shfl_sync(all, value.own.z, of), __shfl_sync(all, value.own.radius, of)};
  }
  template <class T>
  __device__ Lanes<T> shifted(const Lanes<T>& value, std::uint32_t by) const {
    return {from(value, (lane() + by) % lanes)};
  }
};

struct DeviceQuad : DeviceTeam<4> {
  template <class F>
  __device__ void once(const F& body) const {
    if (lane() == 0) body();
    __syncwarp();
  }
};

using DeviceOctet = DeviceTeam<8>;

/// How much the lanes before the calling one have together, of a warp that comes whole; `all` is what all
/// have.
struct LaneSum {
  std::uint32_t before, all;
  __device__ static LaneSum of(std::uint32_t own) {
    std::uint32_t upto = own;
    for (std::uint32_t step = 1; step < DeviceWarp::lanes; step *= 2) {
      const std::uint32_t other = __shfl_up_sync(DeviceWarp::all, upto, step);
      if (DeviceWarp::lane() >= step) upto += other;
    }
    return {upto - own, __shfl_sync(DeviceWarp::all, upto, DeviceWarp::lanes - 1)};
  }
};

}  // namespace catena::cuda

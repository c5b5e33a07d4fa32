#pragma once
#include <cstdint>

#include "catena/core/sphere.h"

namespace catena::cuda {

/// The calling warp, whole and together; the host's twin is HostWarp.
struct DeviceWarp {
  static constexpr std::uint32_t lanes = 32, all = 0xFFFFFFFFu;

  /// A value a lane: each thread holds its own, and asks for no other.
  template <class T>
  struct Lanes {
    T own;
    __device__ const T& operator[](std::uint32_t) const { return own; }
  };

  __device__ static std::uint32_t lane() { return threadIdx.x % lanes; }

  template <class F>
  __device__ auto each(const F& value) const {
    return Lanes<decltype(value(0u))>{value(lane())};
  }
  template <class F>
  __device__ void run(const F& body) const {
    body(lane());
    __syncwarp();
  }
  template <class F>
  __device__ void once(const F& body) const {
    if (lane() == 0) body();
    __syncwarp();
  }
  template <class F>
  __device__ std::uint32_t ballot(const F& flag) const {
    const bool own = flag(lane());
    return __ballot_sync(all, own);
  }
  template <class F>
  __device__ float greatest(const F& number) const {
    return __uint_as_float(greatest_of(__float_as_uint(fabsf(number(lane())))));
  }
  template <class T>
  __device__ T from(const Lanes<T>& value, std::uint32_t lane) const {
    return __shfl_sync(all, value.own, static_cast<int>(lane));
  }
  __device__ Sphere from(const Lanes<Sphere>& value, std::uint32_t lane) const {
    const auto of = static_cast<int>(lane);
    return {__shfl_sync(all, value.own.x, of), __shfl_sync(all, value.own.y, of),
            __shfl_sync(all, value.own.z, of), __shfl_sync(all, value.own.radius, of)};
  }
  __device__ Lanes<float> ahead(const Lanes<float>& own, const Lanes<float>& next,
                                std::uint32_t steps) const {
    const auto from = static_cast<int>((lane() + steps) % lanes);
    const float of_own = __shfl_sync(all, own.own, from), of_next = __shfl_sync(all, next.own, from);
    return {lane() + steps < lanes ? of_own : of_next};
  }

 private:
  __device__ static std::uint32_t greatest_of(std::uint32_t v) {
#if __CUDA_ARCH__ >= 800
    return __reduce_max_sync(all, v);
#else
    for (int step = 16; step > 0; step /= 2) v = max(v, __shfl_xor_sync(all, v, step));
    return v;
#endif
  }
};

}  // namespace catena::cuda

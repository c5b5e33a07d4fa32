#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#include "catena/core/host_device.h"

namespace catena {

/// How many bits are set.
CATENA_HD inline std::uint32_t count_bits(std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  return static_cast<std::uint32_t>(__popc(bits));
#else
  return static_cast<std::uint32_t>(__builtin_popcount(bits));
#endif
}

/// How many bits lie above the highest one that is set; bits != 0. Takes that one off.
CATENA_HD inline std::uint32_t take_highest(std::uint32_t& bits) {
#ifdef __CUDA_ARCH__
  const auto above = static_cast<std::uint32_t>(__clz(static_cast<int>(bits)));
#else
  const auto above = static_cast<std::uint32_t>(__builtin_clz(bits));
#endif
  bits &= 0x7FFFFFFFu >> above;
  return above;
}

/// One place up, and below a number's sign: set where it is negative.
CATENA_HD inline std::uint32_t with_sign(std::uint32_t bits, float number) {
#ifdef __CUDA_ARCH__
  return __funnelshift_l(__float_as_uint(number), bits, 1);
#else
  return bits << 1 | static_cast<std::uint32_t>(std::signbit(number));
#endif
}

/// 1 where a number is negative, else 0.
CATENA_HD inline std::uint32_t sign(float number) { return with_sign(0, number); }

/// The number of the lowest bit that is set; bits != 0.
CATENA_HD inline std::uint32_t lowest_bit(std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  return static_cast<std::uint32_t>(__ffs(static_cast<int>(bits)) - 1);
#else
  return static_cast<std::uint32_t>(__builtin_ctz(bits));
#endif
}
/// The same of 64 bits.
CATENA_HD inline std::uint32_t lowest_bit_of_64(std::uint64_t bits) {
#ifdef __CUDA_ARCH__
  return static_cast<std::uint32_t>(__ffsll(static_cast<long long>(bits)) - 1);
#else
  return static_cast<std::uint32_t>(__builtin_ctzll(bits));
#endif
}

/// 2^exponent, from 2^-126 to 2^127.
CATENA_HD inline float power_of_two(std::int32_t exponent) {
  const std::uint32_t bits = static_cast<std::uint32_t>(127 + exponent) << 23;
  float result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

}  // namespace catena

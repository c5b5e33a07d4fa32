#pragma once
#include <cstdint>

#include "catena/core/host_device.h"

namespace catena {

/// Adds to a number that all threads of a kernel share, and returns what it was. Relaxed: whoever needs more
/// than the number itself waits for the kernel's end. The host runs these policies on one thread.
CATENA_HD inline std::uint32_t fetch_add(std::uint32_t* number, std::uint32_t more) {
#ifdef __CUDA_ARCH__
  return atomicAdd(number, more);
#else
  const std::uint32_t before = *number;
  *number += more;
  return before;
#endif
}

/// The same of 64 bits, where nobody asks what it was.
CATENA_HD inline void add(unsigned long long* number, unsigned long long more) {
#ifdef __CUDA_ARCH__
  atomicAdd(number, more);
#else
  *number += more;
#endif
}

/// What such a number is now; it may be more by the time it is used.
template <class Number>
CATENA_HD Number seen(const Number* number) {
  return *static_cast<const volatile Number*>(number);
}

/// Between two looks at such a number.
CATENA_HD inline void wait_a_moment() {
#ifdef __CUDA_ARCH__
  __nanosleep(100);
#endif
}

/// Makes such a number at least this. Most callers find that it is, and a look costs less than an atomic
/// operation.
CATENA_HD inline void raise(std::uint32_t* number, std::uint32_t least) {
#ifdef __CUDA_ARCH__
  if (seen(number) < least) atomicMax(number, least);
#else
  if (*number < least) *number = least;
#endif
}

/// Sets bits of such a number. Most callers find theirs set, and a look costs less than an atomic operation.
CATENA_HD inline void set_bits(std::uint32_t* number, std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  if ((seen(number) & bits) != bits) atomicOr(number, bits);
#else
  *number |= bits;
#endif
}

}  // namespace catena

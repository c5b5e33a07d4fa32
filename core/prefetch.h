#pragma once

namespace catena {

/// Asks for the cache line at an address, which may be any. The empty statement, of which a compiler must
/// assume that it does something, keeps it: GCC 12 takes a function that only asks for lines for one that
/// does nothing, and leaves out each call.
inline void prefetch(const void* at) {
#if defined(__GNUC__)
  __builtin_prefetch(at);
  asm volatile("");
#else
  static_cast<void>(at);
#endif
}

}  // namespace catena

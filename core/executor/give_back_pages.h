#pragma once
#include <cstddef>
#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace catena {

/// Gives the memory of so many bytes back to the system, as far as it is whole pages; what was there is lost,
/// and what is read there is 0 until it is written. For what is emptied from its beginning while something
/// else is filled.
inline void give_back_pages(void* begin, std::size_t bytes) {
#if defined(__linux__)
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page,
             end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_DONTNEED);
#else
  static_cast<void>(begin), static_cast<void>(bytes);
#endif
}

}  // namespace catena

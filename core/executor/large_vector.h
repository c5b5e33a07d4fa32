#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "catena/core/compiled_for.h"

namespace catena {

/// From so many bytes on an array is worth pages of that size.
inline constexpr std::size_t large_page = std::size_t{1} << 21;

/// Asks the system for large pages between two addresses: the first touch of many small ones takes longer
/// than a search. Only a wish.
inline void wish_large_pages(void* begin, std::size_t bytes) {
#if defined(__linux__)
  const auto first = (reinterpret_cast<std::size_t>(begin) + large_page - 1) / large_page * large_page,
             end = (reinterpret_cast<std::size_t>(begin) + bytes) / large_page * large_page;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#else
  static_cast<void>(begin), static_cast<void>(bytes);
#endif
}

/// For arrays that are written before they are read, by several threads perhaps: what resize() adds is not
/// set to zero, and large arrays lie on large pages.
template <class T>
struct LargeAllocator {
  static_assert(std::is_trivially_copyable_v<T>);
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) {
    if (n * sizeof(T) < large_page) return std::allocator<T>().allocate(n);
    void* const memory = ::operator new (n * sizeof(T), std::align_val_t{large_page});
    wish_large_pages(memory, n * sizeof(T));
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) {
    if (n * sizeof(T) < large_page) return std::allocator<T>().deallocate(memory, n);
    ::operator delete (memory, std::align_val_t{large_page});
  }
  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

/// A vector whose memory comes from LargeAllocator.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// From so many bytes on the standard allocator maps memory of its own for an array (mallopt(3)), a page of
/// which costs nothing until it is touched, and then longer than to write it.
inline constexpr std::size_t least_mapped = std::size_t{1} << 17;

/// Appends to an array of the standard kind. One that is mapped grows by more than the usual factor of 2, and
/// to `likely` elements at least: addresses that nothing is written to cost no memory, while memory that is
/// left behind was touched for nothing, which takes longer than what was written there.
template <class T>
void append_large(std::vector<T>& all, std::span<const T> more, std::size_t likely = 0) {
  if (all.capacity() - all.size() < more.size()) {
    const std::size_t least = all.size() + more.size(), capacity = all.capacity();
    const bool mapped = least * sizeof(T) >= least_mapped;
    try {
      all.reserve(std::max({least, 2 * capacity, mapped ? std::max(8 * capacity, likely) : 0}));
    } catch (const std::bad_alloc&) {  // where addresses are counted, too (ulimit -v)
      all.reserve(std::max(least, capacity + capacity / 2));
    }
    wish_large_pages(all.data(), all.capacity() * sizeof(T));
  }
  all.insert(all.end(), more.begin(), more.end());
}

/// Resizes an array of the standard kind that may become large and is to be overwritten: what it held may be
/// lost.
template <class T>
void resize_large(std::vector<T>& all, std::size_t size) {
  if (all.capacity() < size) {
    std::vector<T>().swap(all);
    all.reserve(size);
    wish_large_pages(all.data(), size * sizeof(T));
  }
  all.resize(size);
}

}  // namespace catena

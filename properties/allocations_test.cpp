#include "catena/properties/allocations.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <string_view>
#include <vector>

/// The test program counts its allocations, for the property "no allocation once warm".
namespace {

thread_local std::uint64_t calls = 0, bytes = 0;
constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();
std::atomic<std::int64_t> left = unlimited;  ///< to be given

/// oneTBB's threads start one another, still after the search that wanted them, on machines of many cores;
/// who of them gets no memory for that ends the program.
bool of_onetbb(const void* caller) {
  Dl_info library{};
  return dladdr(caller, &library) != 0 && library.dli_fname != nullptr &&
         std::string_view(library.dli_fname).find("libtbb.so") != std::string_view::npos;
}

void* counted(std::size_t size, std::size_t alignment, const void* caller) {
  if (left.load(std::memory_order_relaxed) != unlimited && left.fetch_sub(1) <= 0 && !of_onetbb(caller))
    throw std::bad_alloc();
  ++calls;
  size += size == 0;
  void* memory = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                     ? std::malloc(size)
                     : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  bytes += malloc_usable_size(memory);
  return memory;
}

void give_back(void* memory) noexcept {
  if (memory != nullptr) bytes -= malloc_usable_size(memory);
  std::free(memory);
}

const bool counting = [] {
  catena::properties::Allocations::counter() = [] { return calls; };
  catena::properties::Allocations::held() = [] { return bytes; };
  catena::properties::Allocations::give() = [](std::int64_t more) { left = more; };
  return true;
}();

void* none_or(void* (&given)(std::size_t), std::size_t size) noexcept {
  try {
    return given(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

// The standard library's array forms would call the others, and hide who calls. Its nothrow forms would, too,
// but not AddressSanitizer's, whose memory must not reach the delete below: std::stable_sort allocates so.
// Aligned arrays are left to it.
void* operator new(std::size_t size) { return counted(size, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t size) { return counted(size, 0, __builtin_return_address(0)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return none_or(operator new, size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return none_or(operator new[], size);
}
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { give_back(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { give_back(memory); }

namespace catena::properties {

namespace {

TEST(Allocations, AreCounted) {
  ASSERT_TRUE(counting);
  const auto before = Allocations::counter()();
  std::vector<int> numbers(100);
  EXPECT_EQ(Allocations::counter()() - before, 1u);
  numbers.reserve(1000);
  EXPECT_EQ(Allocations::counter()() - before, 2u);
  std::stable_sort(numbers.begin(), numbers.end());
  EXPECT_EQ(Allocations::counter()() - before, 3u) << "its buffer is allocated without throwing";
}

}  // namespace
}  // namespace catena::properties

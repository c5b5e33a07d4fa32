#pragma once
#include <cstdint>

namespace catena::properties {

/// Where a program counts its calls of operator new on this thread, if it does: replacing operator new is the
/// program's right, not a library's. Null: nobody counts, and what asks for it does not apply.
struct Allocations {
  using Read = std::uint64_t (*)();
  static Read& counter();
  /// Likewise the bytes that it was given and has not given back, on this thread.
  static Read& held();

  /// Likewise from then on gives all threads so many more, and past them none.
  using Give = void (*)(std::int64_t more);
  static Give& give();
};

}  // namespace catena::properties

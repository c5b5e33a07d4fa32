#pragma once
#include <atomic>
#include <cstdint>

#include "catena/core/executor/large_vector.h"

namespace catena {

/// Which cells have a sphere, and which have another one: bits by the number of the cell's.
class LoneMap {
 public:
  /// None has any.
  void clear(std::uint32_t bits) {
    last_ = bits - 1;
    some_.assign(bits / 8 + 1, 0);
    more_.assign(bits / 8 / share + 1, 0);
  }

  /// One more in this cell; by one thread alone, or several.
  void add(std::uint32_t bit, bool alone) {
    const auto mask = static_cast<std::uint8_t>(1u << bit % 8);
    if ((set(some_[bit / 8], mask, alone) & mask) != 0) set(more_[(bit & last_ / share) / 8], mask, alone);
  }
  /// After the last: what follows the last bit is the first.
  void close() { some_.back() = some_.front(); }

  bool several(std::uint32_t bit) const { return (more_[(bit & last_ / share) / 8] >> bit % 8 & 1) != 0; }
  /// Bit 0 and 1: whether this cell and the next have some.
  std::uint32_t two(std::uint32_t bit) const {
    const std::uint8_t* const at = some_.data() + bit / 8;
    return (at[0] | std::uint32_t{at[1]} << 8) >> bit % 8;
  }

 private:
  /// Cells with several are few, and so many bits of the one map share one of the other.
  static constexpr std::uint32_t share = 8;

  static std::uint8_t set(std::uint8_t& byte, std::uint8_t mask, bool alone) {
    if (!alone) return std::atomic_ref(byte).fetch_or(mask, std::memory_order_relaxed);
    const std::uint8_t before = byte;
    byte = static_cast<std::uint8_t>(before | mask);
    return before;
  }

  std::uint32_t last_ = 0;
  LargeVector<std::uint8_t> some_, more_;
};

}  // namespace catena

#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/compiled_for.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// What one of several threads adds to an array of counts, a byte a count: they do not write to one another's
/// lines of the cache. Kept from search to search, as the first touch of so much memory takes longer than to
/// count in it.
class LaneCounts {
 public:
  static constexpr std::uint32_t page = 4096;

  /// Of `size` counts, all 0. Only what an unfinished search left behind is set to zero here.
  void reset(std::size_t size) {
    if (in_use_ || size != size_) {
      bytes_.clear();
      counted_.clear();
      full_.clear();
    }
    size_ = size;
    in_use_ = true;
  }

  /// One more for count i.
  void add(std::uint32_t i) {
    if (bytes_.empty()) start();
    counted_[i / page] = 1;
    if (++bytes_[i] == 0) full_.push_back(i);
  }

  /// One more for both of each pair.
  void add(std::span<const Pair> pairs) {
    if (bytes_.empty()) start();
    std::uint8_t *const bytes = bytes_.data(), *const counted = counted_.data();
    for (const Pair& pair : pairs)
      for (const std::uint32_t i : {pair.i, pair.j}) {
        counted[i / page] = 1;
        if (++bytes[i] == 0) full_.push_back(i);
      }
  }

  /// Hands over what the bytes of pages `begin` to `end` - 1 hold; when all threads are done.
  void move_pages_to(std::span<std::uint32_t> counts, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < std::min<std::size_t>(end, counted_.size()); ++k) {
      if (!counted_[k]) continue;
      const std::size_t first = std::size_t{k} * page, last = std::min(first + page, size_);
      for (std::size_t i = first; i < last; ++i) counts[i] += bytes_[i];
      std::fill_n(bytes_.data() + first, last - first, std::uint8_t{0});
      counted_[k] = 0;
    }
  }
  /// And what did not fit bytes; after all pages.
  void move_full_to(std::span<std::uint32_t> counts) {
    for (const std::uint32_t i : full_) counts[i] += 256;
    full_.clear();
    in_use_ = false;
  }

 private:
  void start() {
    bytes_.assign(size_, 0);
    counted_.assign((size_ + page - 1) / page, 0);
  }

  std::size_t size_ = 0;
  bool in_use_ = false;  ///< not all was handed over
  LargeVector<std::uint8_t> bytes_;
  std::vector<std::uint8_t> counted_;  ///< [page]: whether something was
  std::vector<std::uint32_t> full_;    ///< a count each time that its byte was full
};

}  // namespace catena

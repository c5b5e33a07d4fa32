#pragma once
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <vector>

namespace catena {

/// What one of several threads adds to an array of counts. A byte a count, in memory that the system gives, zero,
/// where the thread counts something at all: sixteen threads do not take sixteen arrays, and do not write to
/// one another's lines of the cache.
class LaneCounts {
 public:
  static constexpr std::uint32_t page = 4096;

  /// Of `size` counts.
  explicit LaneCounts(std::size_t size) : size_(size) {}

  /// One more for count i.
  void add(std::uint32_t i) {
    if (!bytes_) start();
    counted_[i / page] = 1;
    if (++bytes_.get()[i] == 0) full_.push_back(i);
  }

  /// Adds what the bytes of pages `begin` to `end` - 1 hold; when all threads are done.
  void add_pages_to(std::span<std::uint32_t> counts, std::uint32_t begin, std::uint32_t end) const {
    for (std::uint32_t k = begin; k < std::min<std::size_t>(end, counted_.size()); ++k) {
      if (!counted_[k]) continue;
      const std::size_t first = std::size_t{k} * page, last = std::min(first + page, size_);
      for (std::size_t i = first; i < last; ++i) counts[i] += bytes_.get()[i];
    }
  }
  /// And what did not fit bytes.
  void add_full_to(std::span<std::uint32_t> counts) const {
    for (const std::uint32_t i : full_) counts[i] += 256;
  }

 private:
  struct Free {
    void operator()(std::uint8_t* bytes) const { std::free(bytes); }
  };

  void start() {
    bytes_.reset(static_cast<std::uint8_t*>(std::calloc(size_, 1)));
    if (!bytes_) throw std::bad_alloc();
    counted_.assign((size_ + page - 1) / page, 0);
  }

  std::size_t size_;
  std::unique_ptr<std::uint8_t, Free> bytes_;
  std::vector<std::uint8_t> counted_;  // [page]: whether something was
  std::vector<std::uint32_t> full_;    // a count each time that its byte was full
};

}  // namespace catena

#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace catena {

/// What one of several threads adds to an array of counts. A byte a count, in pages that are made where the
/// thread counts something at all: sixteen threads do not take sixteen arrays, and do not write to one
/// another's lines of the cache.
class LaneCounts {
 public:
  /// One more for counts[i]. When a byte is full, its 256 go to `counts`, atomically.
  void add(std::uint32_t i, std::uint32_t* counts) {
    if (i / page >= pages_.size()) pages_.resize(i / page + 1);
    auto& p = pages_[i / page];
    if (!p) p = std::make_unique<Page>();
    if (++(*p)[i % page] == 0) std::atomic_ref(counts[i]).fetch_add(256, std::memory_order_relaxed);
  }

  /// Adds what is left; when all threads are done.
  void add_to(std::span<std::uint32_t> counts) const {
    for (std::size_t k = 0; k < pages_.size(); ++k) {
      if (!pages_[k]) continue;
      const auto part = counts.subspan(k * page, std::min(page, counts.size() - k * page));
      for (std::size_t i = 0; i < part.size(); ++i) part[i] += (*pages_[k])[i];
    }
  }

 private:
  static constexpr std::size_t page = 4096;
  using Page = std::array<std::uint8_t, page>;
  std::vector<std::unique_ptr<Page>> pages_;
};

}  // namespace catena

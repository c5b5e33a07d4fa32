#pragma once
#include <algorithm>
#include <array>
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
  static constexpr std::uint32_t page = 4096;

  /// One more for count i.
  void add(std::uint32_t i) {
    if (i / page >= pages_.size()) pages_.resize(i / page + 1);
    auto& p = pages_[i / page];
    if (!p) p = std::make_unique<Page>();
    if (++(*p)[i % page] == 0) full_.push_back(i);
  }

  /// Adds what the bytes of pages `begin` to `end` - 1 hold; when all threads are done.
  void add_pages_to(std::span<std::uint32_t> counts, std::uint32_t begin, std::uint32_t end) const {
    for (std::uint32_t k = begin; k < std::min<std::size_t>(end, pages_.size()); ++k) {
      if (!pages_[k]) continue;
      const std::size_t first = std::size_t{k} * page;
      const auto part = counts.subspan(first, std::min<std::size_t>(page, counts.size() - first));
      for (std::size_t i = 0; i < part.size(); ++i) part[i] += (*pages_[k])[i];
    }
  }
  /// And what did not fit bytes.
  void add_full_to(std::span<std::uint32_t> counts) const {
    for (const std::uint32_t i : full_) counts[i] += 256;
  }

 private:
  using Page = std::array<std::uint8_t, page>;
  std::vector<std::unique_ptr<Page>> pages_;
  std::vector<std::uint32_t> full_;  // a count each time that its byte was full
};

}  // namespace catena

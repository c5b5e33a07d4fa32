#include "catena/core/readers/labels.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace catena {

void Labels::add(std::int64_t number) {
  if (!texts_.empty()) throw std::logic_error("labels are numbers or texts, not both");
  // Unsigned, as the number after the greatest is none.
  const auto goes_on = [&](const Run& run) {
    return number > run.number &&
           static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(run.number) == size_ - run.first;
  };
  if (runs_.empty() || !goes_on(runs_.back())) runs_.push_back({size_, number});
  ++size_;
}

void Labels::add(std::string_view text) {
  if (!runs_.empty()) throw std::logic_error("labels are numbers or texts, not both");
  if (size_ % block == 0) block_begin_.push_back(texts_.size());
  std::size_t length = text.size();
  for (; length >= 128; length >>= 7) texts_ += static_cast<char>(length % 128 + 128);
  texts_ += static_cast<char>(length);
  texts_ += text;
  ++size_;
}

std::int64_t Labels::number_of(std::uint32_t i) const {
  const auto run = std::ranges::upper_bound(runs_, i, {}, &Run::first) - 1;
  return run->number + (i - run->first);
}

std::string_view Labels::text_of(std::uint32_t i) const {
  std::uint64_t at = block_begin_[i / block];
  for (std::uint32_t k = i % block;; --k) {
    std::size_t length = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(texts_[at++]);
      length += std::size_t{byte % 128u} << shift;
      if (byte < 128) break;
    }
    if (k == 0) return std::string_view(texts_).substr(at, length);
    at += length;
  }
}

std::string Labels::of(std::uint32_t i) const {
  if (size_ == 0) return std::to_string(i);
  if (i >= size_) throw std::out_of_range("a label of a sphere that has none");
  return runs_.empty() ? std::string(text_of(i)) : std::to_string(number_of(i));
}

bool Labels::surely_differ() const {
  if (size_ == 0) return true;
  if (runs_.empty()) return false;
  std::vector<Run> runs = runs_;
  const auto end_of = [&](std::size_t k) { return k + 1 < runs_.size() ? runs_[k + 1].first : size_; };
  for (std::size_t k = 0; k < runs.size(); ++k) runs[k].first = end_of(k) - runs_[k].first;  // its size
  std::ranges::sort(runs, {}, &Run::number);
  return std::ranges::adjacent_find(runs, [](const Run& a, const Run& b) {
           return static_cast<std::uint64_t>(b.number) - static_cast<std::uint64_t>(a.number) < a.first;
         }) == runs.end();
}

std::uint64_t Labels::hash_of(std::uint32_t i) const {
  return runs_.empty() ? std::hash<std::string_view>()(text_of(i))
                       : static_cast<std::uint64_t>(number_of(i)) * 0x9E3779B97F4A7C15;
}

Labels Labels::chosen(std::span<const std::uint32_t> spheres) const {
  Labels chosen;
  chosen.strand_names = strand_names;
  if (size_ == 0) return chosen;
  for (const std::uint32_t i : spheres)
    if (runs_.empty())
      chosen.add(text_of(i));
    else
      chosen.add(number_of(i));
  return chosen;
}

}  // namespace catena

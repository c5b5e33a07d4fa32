#include "catena/core/readers/labels.h"

#include <algorithm>
#include <stdexcept>

namespace catena {

void Labels::add(std::int64_t number) {
  if (!text_end_.empty()) throw std::logic_error("labels are numbers or texts, not both");
  if (runs_.empty() || number != runs_.back().number + (size_ - runs_.back().first))
    runs_.push_back({size_, number});
  ++size_;
}

void Labels::add(std::string_view text) {
  if (!runs_.empty()) throw std::logic_error("labels are numbers or texts, not both");
  texts_ += text;
  text_end_.push_back(texts_.size());
  ++size_;
}

std::int64_t Labels::number_of(std::uint32_t i) const {
  const auto run = std::ranges::upper_bound(runs_, i, {}, &Run::first) - 1;
  return run->number + (i - run->first);
}

std::string_view Labels::text_of(std::uint32_t i) const {
  const std::uint64_t begin = i == 0 ? 0 : text_end_[i - 1];
  return std::string_view(texts_).substr(begin, text_end_[i] - begin);
}

std::string Labels::of(std::uint32_t i) const {
  if (size_ == 0) return std::to_string(i);
  if (i >= size_) throw std::out_of_range("a label of a sphere that has none");
  return runs_.empty() ? std::string(text_of(i)) : std::to_string(number_of(i));
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

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

std::string Labels::of(std::uint32_t i) const {
  if (size_ == 0) return std::to_string(i);
  if (i >= size_) throw std::out_of_range("a label of a sphere that has none");
  if (runs_.empty()) {
    const std::uint64_t begin = i == 0 ? 0 : text_end_[i - 1];
    return texts_.substr(begin, text_end_[i] - begin);
  }
  const auto run = std::ranges::upper_bound(runs_, i, {}, &Run::first) - 1;
  return std::to_string(run->number + (i - run->first));
}

Labels Labels::without(std::span<const std::uint32_t> spheres) const {
  Labels kept;
  kept.strand_names = strand_names;
  auto next = spheres.begin();
  auto run = runs_.begin();
  for (std::uint32_t i = 0; i < size_; ++i) {
    if (run != runs_.end() && run + 1 != runs_.end() && (run + 1)->first == i) ++run;
    if (next != spheres.end() && *next == i)
      ++next;
    else if (runs_.empty())
      kept.add(of(i));
    else
      kept.add(run->number + (i - run->first));
  }
  return kept;
}

}  // namespace catena

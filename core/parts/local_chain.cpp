#include "catena/core/parts/local_chain.h"

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/parts/across_pieces.h"

namespace catena::parts {

LocalChain::LocalChain(const Chain& whole, const PartRanges& part, Neighbours neighbours)
    : by_number_(neighbours == Neighbours::by_number && whole.view().exclusion.one_open_strand &&
                 whole.view().exclusion.extra_row == nullptr) {
  take(part.before);
  own_.begin = size();
  take(part.own);
  own_.end = size();
  take(part.after);
  if (runs_.size() > few)
    for (std::uint32_t at = 0, run = 0; at < size(); at += stride) {
      while (begin_[run + 1] <= at) ++run;
      run_at_.push_back(run);
    }
  if (by_number_) return;
  cut_pieces(whole);
  extra_ = neighbours_across(whole, pieces_);
}

void LocalChain::take(const std::vector<SphereRange>& ranges) {
  for (const SphereRange& range : ranges) {
    if (range.size() == 0) continue;
    if (std::uint64_t{size()} + range.size() >= std::uint64_t{1} << 31)
      throw CapacityError("a part of the chain and its halo have 2^31 spheres or more");
    const std::uint32_t end = size() + range.size();
    const bool goes_on = !runs_.empty() && runs_.back().end == range.begin;
    append(runs_, range);
    goes_on ? static_cast<void>(begin_.back() = end) : begin_.push_back(end);
  }
}

void LocalChain::cut_pieces(const Chain& whole) {
  const auto& starts = whole.strands().first;
  std::uint32_t begin = 0;
  for (const SphereRange& run : runs_) {
    auto s = static_cast<std::size_t>(std::ranges::upper_bound(starts, run.begin) - starts.begin());
    for (std::uint32_t at = run.begin; at < run.end; ++s) {
      const auto strand = static_cast<std::uint32_t>(s - 1);
      const std::uint32_t end = std::min(run.end, starts[s]);
      if (end == at) continue;
      const bool complete = at == starts[strand] && end == starts[s];
      pieces_.push_back({at, begin, end - at, strand, complete && whole.strands().closed[strand] != 0});
      begin += end - at;
      at = end;
    }
  }
}

}  // namespace catena::parts

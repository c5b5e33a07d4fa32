#include "catena/core/frames/frame_answer.h"

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/frames/count_pairs.h"

namespace catena {

void FrameAnswer::copy(const Collisions& from) {
  all_.pairs.assign(from.pairs.begin(), from.pairs.end());
  counts_ = Counts::unknown;
  all_.count.reserve(from.count.size());  // so that no later frame allocates
  if (few_pairs(from.count.size())) return;
  all_.count.assign(from.count.begin(), from.count.end());
  counts_ = Counts::stand;
}

void FrameAnswer::shift(std::uint32_t n, std::int64_t s) {
  std::vector<std::uint32_t>& counts = all_.count;
  bool follow = counts_ == Counts::stand;
  if (follow && few_pairs(n)) {
    for (const Pair& p : all_.pairs) counts[p.i] = counts[p.j] = 0;
    counts_ = Counts::zero;
    follow = false;
  } else if (follow) {
    if (s > 0)
      std::fill(std::copy(counts.begin() + s, counts.end(), counts.begin()), counts.end(), 0);
    else
      std::fill(counts.begin(), std::copy_backward(counts.begin(), counts.end() + s, counts.end()), 0);
  }
  const auto there = [n](std::int64_t i) { return i >= 0 && i < std::int64_t{n}; };
  std::size_t left = 0;
  for (const Pair& p : all_.pairs) {
    const std::int64_t i = p.i - s, j = p.j - s;
    if (i >= 0 && j < std::int64_t{n}) {
      all_.pairs[left++] = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)};
    } else if (follow) {
      if (there(i)) --counts[static_cast<std::size_t>(i)];
      if (there(j)) --counts[static_cast<std::size_t>(j)];
    }
  }
  all_.pairs.resize(left);
}

void FrameAnswer::exchange(std::span<const std::uint32_t> places, std::span<const Pair> instead) {
  if (counts_ == Counts::stand) {
    for (const std::uint32_t place : places)
      --all_.count[all_.pairs[place].i], --all_.count[all_.pairs[place].j];
    count_pairs(instead, all_.count);
  }
  const std::size_t same = std::min(places.size(), instead.size());
  for (std::size_t k = 0; k < same; ++k) all_.pairs[places[k]] = instead[k];
  all_.pairs.insert(all_.pairs.end(), instead.begin() + static_cast<std::ptrdiff_t>(same), instead.end());
  // From the last one on, so that what fills a place is to stay.
  for (std::size_t k = places.size(); k-- > same;) {
    all_.pairs[places[k]] = all_.pairs.back();
    all_.pairs.pop_back();
  }
}

void FrameAnswer::report(std::uint32_t n, const Request& request, Collisions& result) const {
  if (request.want == Request::Want::any || request.queries.within(n) != SphereRange{0, n} ||
      all_.pairs.size() > request.pair_limit) {
    PairCollector collector(n, request, result);
    for (const Pair& p : all_.pairs) collector.lane(0).collide(p.i, p.j);
    return collector.finish();
  }
  if (counts_ == Counts::stand) {
    result.count.assign(all_.count.begin(), all_.count.end());
  } else {
    result.count.assign(n, 0);
    count_pairs(all_.pairs, result.count);
  }
  result.found = !all_.pairs.empty();
  result.pair_count = all_.pairs.size();
  if (request.want == Request::Want::pairs)
    result.pairs.assign(all_.pairs.begin(), all_.pairs.end());
  else
    result.pairs.clear();
}

const Collisions& FrameAnswer::standing(std::uint32_t n, const Request& request) {
  all_.found = !all_.pairs.empty();
  all_.pair_count = all_.pairs.size();
  if (request.want == Request::Want::any) return all_;
  if (request.want == Request::Want::pairs && all_.pair_count > request.pair_limit)
    throw PairLimitExceeded(all_.pair_count, request.pair_limit);
  if (counts_ == Counts::stand) return all_;
  if (counts_ == Counts::unknown) all_.count.assign(n, 0);
  count_pairs(all_.pairs, all_.count);
  counts_ = Counts::stand;
  return all_;
}

}  // namespace catena

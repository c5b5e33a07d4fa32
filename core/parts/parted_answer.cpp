#include "catena/core/parts/parted_answer.h"

#include <algorithm>
#include <limits>

#include "catena/core/error.h"
#include "catena/core/executor/large_vector.h"

namespace catena::parts {

/// body(begin, end) for what one core takes at a time of an array.
template <class Body>
void PartedAnswer::for_each_stretch(std::size_t count, const Body& body) const {
  constexpr std::size_t stretch = 1u << 15;
  const auto stretches = static_cast<std::uint32_t>((count + stretch - 1) / stretch);
  team_.for_each_range(stretches, 1, [&](std::uint32_t begin, std::uint32_t end) {
    body(begin * stretch, std::min(end * stretch, count));
  });
}

void PartedAnswer::begin(const Request& request, std::uint32_t spheres, std::size_t parts,
                         Collisions& result) {
  request_ = request;
  spheres_ = spheres;
  result_ = &result;
  if (request.want == Request::Want::any)
    result.count.clear();
  else
    resize_large(result.count, spheres);
  found_.resize(parts + 1);
  for (Found& found : found_) found.any = false, found.pairs = 0, found.list.clear();
}

Request PartedAnswer::asked(std::size_t k, const LocalChain& part, Collisions& found) {
  found.pairs.swap(found_[k].list);
  Request request = request_;
  request.queries = part.own();
  if (!asks_for_all())  // what is not asked for is left out of all pairs of the part
    request.want = Request::Want::pairs, request.pair_limit = std::numeric_limits<std::uint64_t>::max();
  return request;
}

bool PartedAnswer::lie_together(const LocalChain& part) const {
  const SphereRange own = part.own();
  return own.size() > 0 && part.id(own.end - 1) - part.id(own.begin) == own.size() - 1;
}

std::span<std::uint32_t> PartedAnswer::place_of_counts(const LocalChain& part,
                                                       std::vector<std::uint32_t>& apart) const {
  if (request_.want == Request::Want::any) return {};
  if (lie_together(part)) return {result_->count.data() + part.id(part.own().begin), part.own().size()};
  apart.resize(part.own().size());
  return apart;
}

void PartedAnswer::take(std::size_t k, const LocalChain& part, std::span<const std::uint32_t> count,
                        Collisions& found) {
  if (request_.want != Request::Want::any) take_counts(part, count);
  take_pairs(part, found, found_[k]);
  if (!asks_for_all()) leave_out_unasked(found_[k]);
}

void PartedAnswer::take_too_many(std::size_t k, std::uint64_t pairs) {
  found_[k].any = true;
  found_[k].pairs = pairs;
}

void PartedAnswer::take_counts(const LocalChain& part, std::span<const std::uint32_t> count) {
  const SphereRange own = part.own();
  const bool there = lie_together(part), all = asks_for_all();
  if (there && all) return;
  for (std::size_t k = 0; k < part.runs().size(); ++k) {
    const SphereRange run = part.runs()[k];
    const std::uint32_t begin = std::max(part.begins()[k], own.begin),
                        end = std::min(part.begins()[k] + run.size(), own.end);
    if (begin >= end) continue;
    std::uint32_t* const to = result_->count.data() + run.begin + (begin - part.begins()[k]);
    if (!there) std::copy(count.begin() + (begin - own.begin), count.begin() + (end - own.begin), to);
    const auto first = static_cast<std::uint32_t>(to - result_->count.data());
    for (std::uint32_t i = 0; !all && i < end - begin; ++i)
      if (!request_.queries.contains(first + i)) to[i] = 0;
  }
}

void PartedAnswer::take_pairs(const LocalChain& part, Collisions& found, Found& to) const {
  to.any = found.found;
  to.pairs = found.pair_count;
  to.list.swap(found.pairs);
  for_each_stretch(to.list.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t a = part.id(to.list[k].i), b = part.id(to.list[k].j);
      to.list[k] = {std::min(a, b), std::max(a, b)};
    }
  });
}

void PartedAnswer::leave_out_unasked(Found& found) const {
  std::erase_if(found.list, [&](const Pair& pair) { return !request_.queries.contains(pair.i); });
  found.pairs = found.list.size();
  found.any = found.pairs > 0;
}

Request PartedAnswer::asked_between(const LocalChain& between, Collisions& found) {
  found.pairs.swap(found_.back().list);
  return {.pair_limit = std::numeric_limits<std::uint64_t>::max(), .queries = between.own()};
}

void PartedAnswer::take_between(const LocalChain& between,
                                const std::function<std::size_t(std::uint32_t sphere)>& part_of,
                                Collisions& found) {
  Found& to = found_.back();
  take_pairs(between, found, to);
  std::erase_if(to.list, [&](const Pair& pair) { return part_of(pair.i) == part_of(pair.j); });
  if (request_.want != Request::Want::any)
    for (const Pair& pair : to.list)
      for (const std::uint32_t sphere : {pair.i, pair.j})
        if (request_.queries.contains(sphere)) ++result_->count[sphere];
  leave_out_unasked(to);
  if (request_.want != Request::Want::pairs) to.list.clear();
}

void PartedAnswer::gather() {
  Collisions& result = *result_;
  result.found = std::ranges::any_of(found_, &Found::any);
  result.pair_count = 0;
  if (request_.want != Request::Want::pairs) result.pairs.clear();
  if (request_.want == Request::Want::any) return;
  for (const Found& found : found_) result.pair_count += found.pairs;
  if (request_.want != Request::Want::pairs) return;
  if (result.pair_count > request_.pair_limit)
    throw PairLimitExceeded(result.pair_count, request_.pair_limit);
  if (found_[0].list.size() == result.pair_count) return result.pairs.swap(found_[0].list);
  resize_large(result.pairs, result.pair_count);
  auto to = result.pairs.begin();
  for (const Found& found : found_) {
    for_each_stretch(found.list.size(), [&](std::size_t begin, std::size_t end) {
      std::copy(found.list.begin() + static_cast<std::ptrdiff_t>(begin),
                found.list.begin() + static_cast<std::ptrdiff_t>(end),
                to + static_cast<std::ptrdiff_t>(begin));
    });
    to += static_cast<std::ptrdiff_t>(found.list.size());
  }
}

}  // namespace catena::parts

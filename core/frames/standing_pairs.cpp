#include "catena/core/frames/standing_pairs.h"

#include <algorithm>
#include <utility>

namespace catena {

void StandingPairs::clear(std::size_t listed) {
  at_.resize(listed);
  std::ranges::fill(at_, nowhere);
  who_.clear();
}

void StandingPairs::exchange(std::span<const std::uint32_t> changed, std::span<const Pair> list,
                             std::span<const std::uint32_t> spheres, std::vector<Pair>& pairs,
                             std::vector<std::uint32_t>& counts) {
  // Which way one goes is hard to foretell, and so parted without a branch.
  come_.resize(changed.size()), go_.resize(changed.size());
  std::size_t come = 0, go = 0;
  for (const std::uint32_t k : changed) {
    const bool stands = at_[k] != nowhere;
    come_[come] = go_[go] = k;
    come += !stands, go += stands;
  }
  const auto put = [&](std::uint32_t k, std::uint32_t place) {
    const auto [low, high] = std::minmax(spheres[list[k].i], spheres[list[k].j]);
    pairs[place] = {low, high};
    ++counts[low], ++counts[high];
    at_[k] = place, who_[place] = k;
  };
  const auto uncount = [&](std::uint32_t k) {
    const Pair& p = pairs[at_[k]];
    --counts[p.i], --counts[p.j];
  };
  const std::size_t same = std::min(come, go), stood = pairs.size();
  for (std::size_t n = 0; n < same; ++n) {
    uncount(go_[n]);
    put(come_[n], std::exchange(at_[go_[n]], nowhere));
  }
  pairs.resize(stood + (come - same)), who_.resize(pairs.size());
  for (std::size_t n = same; n < come; ++n) put(come_[n], static_cast<std::uint32_t>(stood + (n - same)));
  for (std::size_t n = same; n < go; ++n) {
    uncount(go_[n]);
    // The last one takes its place.
    const std::uint32_t last = who_.back(), place = at_[go_[n]];
    pairs[place] = pairs.back(), who_[place] = last, at_[last] = place;
    at_[go_[n]] = nowhere;
    pairs.pop_back(), who_.pop_back();
  }
}

}  // namespace catena

#include "catena/core/parts/local_chain.h"

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/parts/across_pieces.h"

namespace catena::parts {

LocalChain::LocalChain(const Chain& whole, const Partition& partition, std::uint32_t part)
    : group_(partition.group()) {
  take_groups(whole, partition, part);
  cut_pieces(whole);
  extra_ = neighbours_across(whole, pieces_);
}

void LocalChain::take_groups(const Chain& whole, const Partition& partition, std::uint32_t part) {
  std::uint64_t spheres = 0;
  const auto take = [&](std::span<const std::uint32_t> groups) {
    for (const std::uint32_t g : groups) {
      const std::uint64_t first = std::uint64_t{g} * group_,
                          end = std::min<std::uint64_t>(first + group_, whole.size());
      group_at_.push_back(g);
      spheres += end - first;
      if (end - first < group_)
        short_end_ = static_cast<std::uint32_t>(spheres),
        missing_ = static_cast<std::uint32_t>(group_ - (end - first));
      if (!runs_.empty() && runs_.back().end == first)
        runs_.back().end = static_cast<std::uint32_t>(end);
      else
        runs_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)});
      if (spheres >> 31 != 0)
        throw CapacityError("a part of the chain and its halo have 2^31 spheres or more");
    }
    return static_cast<std::uint32_t>(spheres);
  };
  own_.begin = take(partition.halo_before(part));
  own_.end = take(partition.own(part));
  size_ = take(partition.halo_after(part));
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

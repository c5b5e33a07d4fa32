#include "catena/core/ranks/regions.h"

#include "catena/core/ranks/bytes.h"

namespace catena::ranks {

Regions Regions::of_all(Communicator& ranks, const Box& own) {
  Regions regions;
  regions.own_ = own;
  const std::vector<Box> all = all_gather_value(ranks, own);
  for (unsigned rank = 0; rank < ranks.size(); ++rank)
    if (rank != ranks.rank() && is_somewhere(own) && is_somewhere(all[rank]) && all[rank].meets(own))
      regions.neighbours_.push_back(rank);
  const auto size = static_cast<std::uint32_t>(regions.neighbours_.size());
  regions.others_.clear(size);
  for (std::uint32_t k = 0; k < size; ++k) regions.others_.set(k, all[regions.neighbours_[k]]);
  regions.others_.refresh(0, size);
  return regions;
}

}  // namespace catena::ranks

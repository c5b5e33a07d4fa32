#include "catena/core/frames/kept_list.h"

#include <algorithm>
#include <cmath>

#include "catena/core/error.h"
#include "catena/core/frames/count_pairs.h"
#include "catena/core/frames/near_pairs.h"

namespace catena {

bool KeptList::can_keep(const Chain& chain) {
  return chain.exclusion().rule == Exclusion::Rule::index_window;
}

bool KeptList::make(const Chain& chain, float skin, float inner_skin, std::uint64_t most,
                    const FullSearch& search) {
  made_ = false;
  std::vector<Sphere> spheres = std::move(thick_).release();
  spheres.assign(chain.spheres().begin(), chain.spheres().end());
  bool finite = true;
  for (Sphere& s : spheres) {
    const float thick = s.radius + skin;
    finite &= std::isfinite(thick);
    s.radius = std::isfinite(thick) ? thick : s.radius;
  }
  thick_ = chain.moved(std::move(spheres));
  if (!finite) return false;
  Request request;
  request.pair_limit = most;
  try {
    search(thick_, request, near_);
  } catch (const PairLimitExceeded&) {
    return false;
  }
  skin_ = skin;
  inner_skin_ = inner_skin;
  pruned_ = false;
  made_ = true;
  return true;
}

bool KeptList::holds(const Chain& chain) const {
  return made_ && chain.size() == thick_.size() && all_within(chain.spheres(), thick_.spheres());
}

bool KeptList::inner_holds(std::span<const Sphere> now) const {
  return pruned_ && all_near(now, pruned_at_, inner_skin_);
}

void KeptList::prune(std::span<const Sphere> now) {
  pruned_at_.assign(now.begin(), now.end());
  part_pairs(now, near_.pairs, inner_skin_, settled_, inner_);
  settled_counts_.assign(now.size(), 0);
  count_pairs(settled_, settled_counts_);
  pruned_ = true;
}

bool KeptList::find(std::span<const Sphere> now, std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts,
                    bool stand) {
  const bool stale = !inner_holds(now);
  if (stale) prune(now), stand = false;
  const std::size_t settled = settled_.size();
  if (!stand) pairs.assign(settled_.begin(), settled_.end());
  find_colliding(now, inner_, settled, pairs);
  counts.assign(settled_counts_.begin(), settled_counts_.end());
  count_pairs(std::span(pairs).subspan(settled), counts);
  return stale;
}

}  // namespace catena

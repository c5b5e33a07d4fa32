#include "catena/core/frames/kept_list.h"

#include <algorithm>
#include <cmath>

#include "catena/core/error.h"

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
  give_places();
  skin_ = skin;
  inner_skin_ = inner_skin;
  pruned_ = false;
  made_ = true;
  return true;
}

bool KeptList::holds(const Chain& chain) const {
  return made_ && chain.size() == thick_.size() && all_within(chain.spheres(), thick_.spheres());
}

void KeptList::give_places() {
  constexpr std::uint32_t none = 0xFFFFFFFF;
  place_of_.assign(thick_.size(), none);
  sphere_at_.resize(thick_.size());
  std::uint32_t places = 0;
  const auto place = [&](std::uint32_t i) {
    if (place_of_[i] == none) sphere_at_[places] = i, place_of_[i] = places++;
    return place_of_[i];
  };
  for (Pair& p : near_.pairs) p = {place(p.i), place(p.j)};
  sphere_at_.resize(places);
  size_ = near_.pairs.size();
  near_.pairs.resize(size_ + 7);
}

bool KeptList::inner_holds(std::span<const Sphere> here) const {
  return pruned_ && all_near(here, pruned_at_, inner_skin_);
}

bool KeptList::find(std::span<const Sphere> now, std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts,
                    bool stand) {
  const std::span<const Pair> near = std::span(near_.pairs).first(size_);
  here_.resize(sphere_at_.size());
  for (std::size_t k = 0; k < here_.size(); ++k) here_[k] = now[sphere_at_[k]];
  if (!stand || !pruned_) {
    collide_.assign((size_ + 7) / 8, 0);
    standing_.clear(size_);
    pairs.clear();
    counts.assign(now.size(), 0);
    pruned_ = false;
  }
  const bool stale = !inner_holds(here_);
  if (stale) {
    part_pairs(here_, near, inner_skin_, collide_, changed_, open_);
    pruned_at_ = here_;
    pruned_ = true;
  } else {
    compare_open(here_, open_, changed_);
    for (const std::uint32_t k : changed_) collide_[k / 8] ^= static_cast<std::uint8_t>(1u << (k % 8));
  }
  standing_.exchange(changed_, near, sphere_at_, pairs, counts);
  return stale;
}

}  // namespace catena

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
  near_.pairs.resize(near_.pairs.capacity());  // so that several threads write to all of it
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
  pruned_ = covered_ = looked_ = false;
  made_ = true;
  return true;
}

bool KeptList::holds(const Chain& chain) {
  if (!made_ || chain.size() != thick_.size()) return false;
  look(chain.spheres());
  return (inner_holds_ && covered_) || all_within(chain.spheres(), 0, thick_.spheres());
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
  for (std::uint32_t i = 0; i < thick_.size(); ++i) place(i);
  here_.resize(thick_.size()), pruned_at_.resize(thick_.size());  // so that no later frame allocates
  size_ = near_.pairs.size();
  near_.pairs.resize(size_ + 7);
}

bool KeptList::inner_holds(std::span<const Sphere> here, std::span<const Sphere> before) const {
  return all_near(here, before, inner_skin_);
}

bool KeptList::inner_within(std::span<const Sphere> now) const {
  return all_within(now, inner_skin_, thick_.spheres());
}

/// Puts the spheres into their places, and sees whether the inner skins hold.
void KeptList::look(std::span<const Sphere> now) {
  constexpr std::size_t some = 512;  // which stay in the nearest cache
  inner_holds_ = pruned_;
  for (std::size_t begin = 0; begin < here_.size(); begin += some) {
    const std::size_t end = std::min(begin + some, here_.size());
    for (std::size_t k = begin; k < end; ++k) here_[k] = now[sphere_at_[k]];
    inner_holds_ = inner_holds_ && inner_holds(std::span(here_).subspan(begin, end - begin),
                                               std::span(pruned_at_).subspan(begin, end - begin));
  }
  looked_ = true;
}

bool KeptList::find(std::span<const Sphere> now, std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts,
                    bool stand) {
  if (!looked_) look(now);
  looked_ = false;
  const std::span<const Pair> near = std::span(near_.pairs).first(size_);
  const bool begins = !stand || !pruned_, stale = begins || !inner_holds_;
  if (begins) {
    collide_.assign((size_ + 7) / 8, 0);
    standing_.clear(size_);
    pairs.clear();
    counts.assign(now.size(), 0);
  }
  if (stale) {
    part_pairs(here_, near, open_skin(), collide_, changed_, open_);
    pruned_at_.swap(here_);
    pruned_ = true;
    covered_ = inner_within(now);
  } else {
    compare_open(here_, open_, changed_);
    for (const std::uint32_t k : changed_) collide_[k / 8] ^= static_cast<std::uint8_t>(1u << (k % 8));
  }
  standing_.exchange(changed_, near, sphere_at_, pairs, counts);
  return stale;
}

}  // namespace catena

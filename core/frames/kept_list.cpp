#include "catena/core/frames/kept_list.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"
#include "catena/core/frames/within.h"

namespace catena {

bool KeptList::can_keep(const Chain& chain) {
  return chain.exclusion().rule == Exclusion::Rule::index_window;
}

bool KeptList::make(const Chain& chain, float skin, std::uint64_t most, const FullSearch& search) {
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
  sort();
  skin_ = skin;
  made_ = true;
  return true;
}

bool KeptList::holds(const Chain& chain) const {
  if (!made_ || chain.size() != thick_.size()) return false;
  constexpr std::size_t step = 512;  // without a branch; a list that does not hold is seen soon
  const std::span<const Sphere> now = chain.spheres(), thick = thick_.spheres();
  for (std::size_t begin = 0; begin < now.size(); begin += step) {
    const std::size_t end = std::min(begin + step, now.size());
    bool all = true;
    for (std::size_t i = begin; i < end; ++i) all &= within(now[i], thick[i]);
    if (!all) return false;
  }
  return true;
}

/// By tiles of the chain against tiles, so that the spheres of many pairs in a row stay in the cache.
void KeptList::sort() {
  const std::uint32_t n = thick_.size();
  constexpr std::uint32_t least_tile = 16384, most_tiles = 64;
  const std::uint32_t tile = std::max(least_tile, n / most_tiles + 1);
  const std::size_t tiles = n / tile + 1;
  const auto key = [&](const Pair& p) { return p.i / tile * tiles + p.j / tile; };
  begin_.assign(tiles * tiles + 1, 0);
  for (const Pair& p : near_.pairs) ++begin_[key(p) + 1];
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  sorted_.resize(near_.pairs.size());
  for (const Pair& p : near_.pairs) sorted_[begin_[key(p)]++] = p;
}

void KeptList::find(std::span<const Sphere> now, std::vector<Pair>& pairs,
                    std::vector<std::uint32_t>& counts) const {
  pairs.clear();
  counts.assign(now.size(), 0);
  // Which of them collide is hard to foretell, and so found without a branch; who is undecided is rare.
  constexpr std::size_t room = 1024, ahead = 24;
  std::array<Pair, room> sure, open;
  for (std::size_t begin = 0; begin < sorted_.size(); begin += room) {
    const std::size_t end = std::min(sorted_.size(), begin + room);
    std::size_t sures = 0, opens = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const Pair p = sorted_[k], later = sorted_[std::min(k + ahead, sorted_.size() - 1)];
      __builtin_prefetch(&now[later.j]);
      __builtin_prefetch(&counts[later.j], 1);
      const Sphere a = now[p.i], b = now[p.j];
      const bool collide = Robust::surely_overlap(a, b);
      counts[p.i] += collide;
      counts[p.j] += collide;
      sure[sures] = open[opens] = p;
      sures += collide;
      opens += !collide & !Robust::separate(a, b);
    }
    for (std::size_t k = 0; k < opens; ++k)
      if (const Pair p = open[k]; Robust::overlap(now[p.i], now[p.j]))
        pairs.push_back(p), ++counts[p.i], ++counts[p.j];
    pairs.insert(pairs.end(), sure.begin(), sure.begin() + static_cast<std::ptrdiff_t>(sures));
  }
}

}  // namespace catena

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

void KeptList::sort() {
  const std::uint32_t n = thick_.size();
  first_.assign(n + std::size_t{2}, 0);
  for (const Pair& p : near_.pairs) ++first_[p.i + std::size_t{2}];
  for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
  partner_.resize(near_.pairs.size());
  for (const Pair& p : near_.pairs) partner_[first_[p.i + std::size_t{1}]++] = p.j;
}

void KeptList::find(std::span<const Sphere> now, std::vector<Pair>& pairs) const {
  pairs.clear();
  // Which of them are near enough is hard to foretell, and so found without a branch.
  std::array<Pair, 1024> close;
  std::size_t count = 0;
  const auto hand_over = [&] {
    std::size_t hits = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Pair p = close[k];
      close[hits] = p;
      hits += Robust::overlap(now[p.i], now[p.j]);
    }
    pairs.insert(pairs.end(), close.begin(), close.begin() + static_cast<std::ptrdiff_t>(hits));
    count = 0;
  };
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    const Sphere a = now[i];
    for (std::uint64_t k = first_[i]; k < first_[i + std::size_t{1}]; ++k) {
      const std::uint32_t j = partner_[k];
      close[count] = {i, j};
      count += !Robust::separate(a, now[j]);
      if (count == close.size()) hand_over();
    }
  }
  hand_over();
}

}  // namespace catena

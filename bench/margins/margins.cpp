#include "catena/bench/margins/margins.h"

#include <algorithm>
#include <cmath>

#include "catena/reference/find_in_box.h"

namespace catena::bench {

void Margins::add(const Pair& pair, bool collides, double margin) {
  Side& side = collides ? colliding : apart;
  ++side.pairs;
  const double place = margin > 0 ? std::floor(-std::log10(margin)) : static_cast<double>(decades);
  ++side.decade[static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(decades - 1)))];
  touching += margin == 0;
  open_in_binary32 += margin <= 12 * 0x1p-24;
  open_in_binary64 += margin <= 10 * 0x1p-53;
  if (margin > least || (margin == least && !(pair < tightest))) return;
  least = margin;
  tightest = pair;
  tightest_collides = collides;
}

Margins margins_of(const Chain& chain, double rounding, const PeriodicBox* box) {
  Margins margins;
  margins.rounding = rounding;
  // Two centres, each moved by up to sqrt(3) roundings.
  const double reach = 2 * std::sqrt(3.0) * rounding;
  const auto add = [&](const Pair& pair, bool collides, double margin) {
    margins.add(pair, collides, margin);
    if (rounding == 0) return;
    const double touch = double{chain[pair.i].radius} + chain[pair.j].radius;
    const double distance = touch * std::sqrt(std::max(0.0, collides ? 1 - margin : 1 + margin));
    margins.open_by_rounding += std::abs(distance - touch) <= reach;
  };
  box ? reference::near_pairs_in_box(chain, *box, add) : reference::near_pairs(chain, add);
  return margins;
}

}  // namespace catena::bench

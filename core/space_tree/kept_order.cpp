#include "catena/core/space_tree/kept_order.h"

#include <algorithm>
#include <limits>

namespace catena {
namespace {

// Searches of a tenth more pairs take as long as a sort where there is most to search.
constexpr double as_near = 1.1;
constexpr std::uint32_t most_frames = 64, longest_wait = 31;

}  // namespace

void KeptOrder::sorted(std::uint32_t entries, const BoxGroups& around) {
  entries_ = entries;
  frames_ = 0;
  std::fill(middling_, middling_ + axes, 0.0);
  for (std::uint32_t k = 0; k < around.boxes; ++k)
    for (std::uint32_t d = 0; d < axes; ++d)
      middling_[d] += (double{around.field(k, axes + d)} - around.field(k, d)) / around.boxes;
  // Where all lie in a plane they take up some room too.
  const double least = *std::max_element(middling_, middling_ + axes) * 0x1p-10;
  for (double& side : middling_) side = std::max(side, least);
  least_radius_ = around.least_radius, greatest_radius_ = around.greatest_radius;
  then_ = spread(around, 0);
}

bool KeptOrder::may_serve(std::uint32_t entries) {
  if (entries == 0 || entries != entries_ || frames_ >= most_frames) return false;
  if (waits_ == 0) return true;
  --waits_;
  return false;
}

bool KeptOrder::serves(const BoxGroups& around) {
  ++frames_;
  // Thicker spheres, as a list of near pairs is made of, are in no other order.
  const double least = double{around.least_radius} - least_radius_,
               greatest = double{around.greatest_radius} - greatest_radius_,
               grown = least > 0 ? std::max(0.0, std::min(least, greatest))
                                 : std::min(0.0, std::max(least, greatest));
  const Spread now = spread(around, grown);
  // Spheres that come together have more to meet; one that leaves all others makes room for none.
  const bool serve = now.sum <= as_near * then_.sum && now.sum * then_.all <= as_near * then_.sum * now.all;
  wait_ = serve ? 0 : std::min(longest_wait, 2 * wait_ + 1);
  waits_ = wait_;
  return serve;
}

KeptOrder::Spread KeptOrder::spread(const BoxGroups& around, double grown) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Spread spread;
  double low[axes], high[axes];
  std::fill(low, low + axes, infinity), std::fill(high, high + axes, -infinity);
  for (std::uint32_t k = 0; k < around.boxes; ++k) {
    double room = 1;
    for (std::uint32_t d = 0; d < axes; ++d) {
      const double from = around.field(k, d), to = around.field(k, axes + d);
      low[d] = std::min(low[d], from), high[d] = std::max(high[d], to);
      room *= std::max(0.0, to - from - 2 * grown) + middling_[d];
    }
    spread.sum += room;
  }
  spread.all = 1;
  for (std::uint32_t d = 0; d < axes; ++d)
    spread.all *= std::max(0.0, high[d] - low[d] - 2 * grown) + middling_[d];
  return spread;
}

}  // namespace catena

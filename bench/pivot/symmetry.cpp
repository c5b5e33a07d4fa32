#include "catena/bench/pivot/symmetry.h"

#include <algorithm>

namespace catena::bench {

constexpr LatticeSymmetry::Table LatticeSymmetry::make_table() {
  constexpr std::array<std::array<std::uint8_t, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}};
  Table all{};
  std::size_t k = 0;
  for (const auto& from : orders)
    for (int signs = 0; signs < 8; ++signs) {
      for (std::size_t axis = 0; axis < 3; ++axis) all[k].sign[axis] = signs >> axis & 1 ? -1 : 1;
      all[k++].from = from;
    }
  return all;
}

LatticeSymmetry::Products LatticeSymmetry::make_products() {
  const Table& all = all_;
  Products products{};
  for (std::size_t second = 0; second < count; ++second)
    for (std::size_t first = 0; first < count; ++first) {
      Signed both{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t between = all[second].from[axis];
        both.sign[axis] = static_cast<std::int8_t>(all[second].sign[axis] * all[first].sign[between]);
        both.from[axis] = all[first].from[between];
      }
      products[second][first] = static_cast<std::uint8_t>(std::ranges::find(all, both) - all.begin());
    }
  return products;
}

LatticeSymmetry::Inverses LatticeSymmetry::make_inverses() {
  Inverses inverses{};
  for (std::size_t k = 0; k < count; ++k)
    inverses[k] = static_cast<std::uint8_t>(std::ranges::find(products_[k], 0) - products_[k].begin());
  return inverses;
}

LatticeSymmetry::Lanes LatticeSymmetry::make_lanes() {
  Lanes lanes{};
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int plain = all_[k].from[axis], negated = plain + 4;
      lanes[k][axis] = all_[k].sign[axis] > 0 ? plain : negated;
      lanes[k][axis + 4] = all_[k].sign[axis] > 0 ? negated : plain;
    }
    lanes[k][3] = 3, lanes[k][7] = 7;
  }
  return lanes;
}

constexpr LatticeSymmetry::Table LatticeSymmetry::all_ = make_table();
const LatticeSymmetry::Products LatticeSymmetry::products_ = make_products();
const LatticeSymmetry::Inverses LatticeSymmetry::inverses_ = make_inverses();
const LatticeSymmetry::Lanes LatticeSymmetry::lanes_ = make_lanes();

}  // namespace catena::bench

#include "catena/bench/enumerate/other_lattice.h"

#include <algorithm>
#include <cmath>

namespace catena::bench {
namespace {

/// Every vector of coordinates -1, 0 and 1 that is wanted.
template <class Wanted>
std::vector<std::array<int, 3>> steps_where(const Wanted& wanted) {
  std::vector<std::array<int, 3>> steps;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (wanted(x, y, z)) steps.push_back({x, y, z});
  return steps;
}

PublishedTable self_avoiding(int dimensions, const std::string& sequence, std::vector<std::uint64_t> terms) {
  return {dimensions, WalkTable::self_avoiding, sequence, "", std::move(terms)};
}

}  // namespace

std::span<const OtherLattice> other_lattices() {
  // Honeycomb: the cubic lattice's points whose coordinates have the sum 0 or 1, neighbour for neighbour
  // alone: in the plane others are farther apart. Triangular: the face-centred lattice's whose sum is 0. The
  // numbers are OEIS's; A001334's terms are as A177238, of which it is a part, prints them, A001666's and
  // A001336's were not compared with oeis.org, but agree with what is counted here.
  static const std::vector<OtherLattice> lattices{
      {"honeycomb",
       {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
       1,
       false,
       self_avoiding(2, "A001668", {1, 3, 6, 12, 24, 48, 90, 174, 336, 648, 1218})},
      {"triangular",
       steps_where([](int x, int y, int z) { return x * x + y * y + z * z == 2 && x + y + z == 0; }), 2, true,
       self_avoiding(2, "A001334",
                     {1, 6, 30, 138, 618, 2730, 11946, 51882, 224130, 964134, 4133166, 17668938, 75355206})},
      {"diamond",
       {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
       3,
       true,
       self_avoiding(3, "A001394", {1, 4, 12, 36, 108, 324, 948, 2796, 8196, 24060})},
      {"body-centred", steps_where([](int x, int y, int z) { return x * y * z != 0; }), 3, true,
       self_avoiding(3, "A001666", {1, 8, 56, 392, 2648, 17960, 120056, 804824, 5351720})},
      {"face-centred", steps_where([](int x, int y, int z) { return x * x + y * y + z * z == 2; }), 2, true,
       self_avoiding(3, "A001336", {1, 12, 132, 1404, 14700, 152532, 1573716, 16172148})}};
  return lattices;
}

const OtherLattice* other_lattice(std::string_view name) {
  const auto found = std::ranges::find(other_lattices(), name, &OtherLattice::name);
  return found == other_lattices().end() ? nullptr : &*found;
}

float OtherLattice::in_coordinates(float in_steps) const {
  const auto reach = [](float radius) { return 4 * double{radius} * radius; };  // exactly, and times 3 too
  const double farthest = std::floor(spacing * reach(in_steps));  // squared distances of points are whole
  auto radius = static_cast<float>(std::sqrt(spacing) * in_steps);
  while (reach(radius) < farthest) radius = std::nextafter(radius, HUGE_VALF);
  while (reach(radius) >= farthest + 1) radius = std::nextafter(radius, 0.0f);
  return radius;
}

OtherWalk OtherWalk::then(int step) const {
  OtherWalk longer = *this;
  longer.steps |= static_cast<std::uint64_t>(step) << (4 * length);
  ++longer.length;
  return longer;
}

std::vector<std::array<int, 3>> OtherWalk::points() const {
  std::vector<std::array<int, 3>> points{{0, 0, 0}};
  for (int k = 0; k < length; ++k) {
    const auto& step = lattice->steps[steps >> (4 * k) & 15];
    std::array<int, 3> next = points.back();
    for (std::size_t axis = 0; axis < 3; ++axis) next[axis] += k % 2 == 0 ? step[axis] : -step[axis];
    points.push_back(next);
  }
  return points;
}

}  // namespace catena::bench

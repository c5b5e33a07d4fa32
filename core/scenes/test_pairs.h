#pragma once
// For the tests of the scenes only: an independent and simple way to find pairs.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena::test {

/// d^2 - s^2 over s^2 in extended precision, which no scene of this folder comes near the limits of.
inline long double relative_excess(const Sphere& a, const Sphere& b) {
  const long double x = static_cast<long double>(a.x) - b.x, y = static_cast<long double>(a.y) - b.y,
                    z = static_cast<long double>(a.z) - b.z,
                    s = static_cast<long double>(a.radius) + b.radius;
  return (x * x + y * y + z * z) / (s * s) - 1;
}

/// All pairs i < j of spheres of one radius that overlap, neighbours included: spheres sorted by cells as
/// wide as two radii, each met with those of its own and the 13 following cells. O(n log n) unless many share
/// a cell.
inline std::vector<Pair> touching_pairs(std::span<const Sphere> spheres) {
  struct Entry {
    std::int32_t x, y, z;
    std::uint32_t i;
    auto cell() const { return std::tie(x, y, z); }
  };
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    const double width = 2.0001 * spheres[i].radius;
    const auto cell = [&](float c) { return static_cast<std::int32_t>(std::floor(c / width)); };
    entries.push_back({cell(spheres[i].x), cell(spheres[i].y), cell(spheres[i].z), i});
  }
  std::ranges::sort(entries, {}, [](const Entry& e) { return std::tuple(e.x, e.y, e.z, e.i); });

  std::vector<Pair> pairs;
  const auto meet = [&](const Entry& a, const Entry& b) {
    if (relative_excess(spheres[a.i], spheres[b.i]) <= 0)
      pairs.push_back({std::min(a.i, b.i), std::max(a.i, b.i)});
  };
  for (std::size_t e = 0; e < entries.size(); ++e) {
    const Entry& a = entries[e];
    for (std::size_t k = e + 1;
         k < entries.size() && entries[k].x == a.x && entries[k].y == a.y && entries[k].z <= a.z + 1; ++k)
      meet(a, entries[k]);                                                     // own cell and the next in z
    for (const auto& [dx, dy] : {std::pair{0, 1}, {1, -1}, {1, 0}, {1, 1}}) {  // rows of three cells
      const Entry from{a.x + dx, a.y + dy, a.z - 1, 0};
      auto b = std::lower_bound(entries.begin(), entries.end(), from,
                                [](const Entry& l, const Entry& r) { return l.cell() < r.cell(); });
      for (; b != entries.end() && b->x == from.x && b->y == from.y && b->z <= a.z + 1; ++b) meet(a, *b);
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace catena::test

#include "catena/core/grid/sphere_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace catena {
namespace {

/// Fewer spheres are not worth a level: they join the next coarser one. So few cost nothing even if all lie
/// in one cell.
constexpr std::uint32_t least_level = 64;

/// Every octave from the greatest binary32 number to the least; points are the last.
constexpr std::size_t octaves = 280;

/// 0 for radii down to half of the greatest, and so on; does not fall as the radius does.
std::size_t octave(float radius, float greatest) {
  if (radius == 0) return greatest == 0 ? 0 : octaves - 1;
  return static_cast<std::size_t>(std::max(0, -1 - std::ilogb(double{radius} / greatest)));
}

struct Octaves {
  std::array<std::uint32_t, octaves> spheres{}, level{};
  std::array<float, octaves> greatest{};
};

}  // namespace

void lay_out_grid(const ChainView& chain, const CentreBox& box, SphereGrid& grid) {
  const std::uint32_t n = chain.size;
  const float greatest = chain.extent.greatest_radius;
  grid.levels.clear();
  grid.members.clear();
  grid.bucket.resize(n);
  grid.rank.resize(n);
  for (auto* field : {&grid.x, &grid.y, &grid.z, &grid.radius}) field->resize(n + SphereGrid::margin);
  grid.index.resize(n + SphereGrid::margin);

  std::size_t starts = 0;
  const auto add_level = [&](float widest, std::uint32_t first, std::uint32_t end) {
    grid.levels.push_back({map_buckets(widest, box, end - first), first, end, starts});
    starts += grid.levels.back().map.buckets + 1;
  };
  if (n == 0) {
    // no levels
  } else if (octave(chain.extent.least_radius, greatest) == 0) {
    add_level(greatest, 0, n);
  } else {
    Octaves all;
    for (std::uint32_t i = 0; i < n; ++i) {
      const float r = chain.spheres[i].radius;
      const std::size_t o = octave(r, greatest);
      ++all.spheres[o];
      all.greatest[o] = std::max(all.greatest[o], r);
    }
    // From the finest on, octaves are put together until they are worth a level; the coarsest takes what is
    // left.
    std::array<bool, octaves> coarsest{};  // of its level
    std::uint32_t gathered = 0;
    for (std::size_t o = octaves; o-- > 0;) {
      gathered += all.spheres[o];
      coarsest[o] = o == 0 || gathered >= least_level;
      if (coarsest[o]) gathered = 0;
    }
    std::array<std::uint32_t, octaves> next{};
    std::uint32_t first = 0, place = 0;
    float widest = 0;
    for (std::size_t o = 0; o < octaves; ++o) {
      next[o] = place;
      place += all.spheres[o];
      widest = std::max(widest, all.greatest[o]);
      if (o + 1 < octaves && !coarsest[o + 1]) continue;
      add_level(widest, first, place);
      first = place;
      widest = 0;
    }
    grid.members.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) grid.members[next[octave(chain.spheres[i].radius, greatest)]++] = i;
  }
  grid.start.assign(starts, 0);
}

}  // namespace catena

#include "catena/core/grid/sphere_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace catena {
namespace {

/// Every octave from the greatest binary32 number to the least; points are the last.
constexpr std::size_t most_octaves = 280;

/// 0 for radii down to half of the greatest, and so on; does not fall as the radius does.
std::size_t octave(float radius, float greatest) {
  if (radius == 0) return greatest == 0 ? 0 : most_octaves - 1;
  return static_cast<std::size_t>(std::max(0, -1 - std::ilogb(double{radius} / greatest)));
}

}  // namespace

void sort_by_octave(const ChainView& chain, std::span<const std::uint32_t> only, SphereGrid& grid) {
  const std::uint32_t n = only.empty() ? chain.size : static_cast<std::uint32_t>(only.size());
  const auto sphere = [&](std::uint32_t k) { return only.empty() ? k : only[k]; };
  const float greatest = chain.extent.greatest_radius;
  for (auto* field : {&grid.x, &grid.y, &grid.z, &grid.radius}) field->resize(n + SphereGrid::margin);
  grid.index.resize(n + SphereGrid::margin);
  grid.bucket.resize(n);
  grid.rank.resize(n);
  grid.members.clear();
  grid.octaves.clear();
  if (n == 0) return;
  if (octave(chain.extent.least_radius, greatest) == 0) {
    grid.members.assign(only.begin(), only.end());
    grid.octaves.push_back({0, n, greatest});
    return;
  }

  std::array<SphereGrid::Octave, most_octaves> all{};
  for (std::uint32_t k = 0; k < n; ++k) {
    const float r = chain.spheres[sphere(k)].radius;
    SphereGrid::Octave& o = all[octave(r, greatest)];
    ++o.end;
    o.greatest = std::max(o.greatest, r);
  }
  std::uint32_t place = 0;
  for (SphereGrid::Octave& o : all) {
    const std::uint32_t spheres = o.end;
    o.first = o.end = place;
    place += spheres;
  }
  grid.members.resize(n);
  for (std::uint32_t k = 0; k < n; ++k)
    grid.members[all[octave(chain.spheres[sphere(k)].radius, greatest)].end++] = sphere(k);
  for (const SphereGrid::Octave& o : all)
    if (o.first < o.end) grid.octaves.push_back(o);
}

}  // namespace catena

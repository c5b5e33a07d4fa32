#pragma once
#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"

namespace catena::properties {

/// The chain's next frame: spheres change places with their neighbours along the chain, the last ones with
/// the first, and every fifth shrinks to half its radius. Bounds of the old frame are wrong for this one.
inline Chain moved_frame(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  const std::uint32_t n = chain.size();
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres[i] = chain[(i + n / 2) % n];
    if (i % 5 == 0) spheres[i].radius /= 2;
    if (i % 3 == 0) spheres[i].x = -spheres[i].x;
  }
  return chain.moved(std::move(spheres));
}

/// A frame in which only radii change, and one in which the first sphere stays: what a short cut for still
/// frames must not take for still.
inline Chain thinned_frame(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (std::size_t i = 0; i < spheres.size(); i += 2) spheres[i].radius /= 4;
  return chain.moved(std::move(spheres));
}
inline Chain anchored_frame(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (std::size_t i = 1; i < spheres.size(); ++i) spheres[i].x = -spheres[i].x;
  return chain.moved(std::move(spheres));
}

/// A frame in which every sphere moves by a part of its radius, each by another, and none beyond what is
/// finite: what was sorted in space lies in much the same order still.
inline Chain shaken_frame(const Chain& chain) {
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    Sphere& s = spheres[i];
    const auto move = [&](float& x, std::size_t often) {
      const float by = s.radius / (i % often == 0 ? 8 : 32);
      x += x > 0 ? -by : by;
    };
    move(s.x, 2), move(s.y, 3), move(s.z, 5);
  }
  return chain.moved(std::move(spheres));
}

/// A frame in which some stretches move and the rest stays, and those stretches: the first of them the first
/// sphere alone, one in the middle, one across a power of two, one the last sphere.
inline std::pair<Chain, std::vector<SphereRange>> partly_moved_frame(const Chain& chain) {
  const std::uint32_t n = chain.size();
  std::vector<SphereRange> ranges;
  if (n == 0) return {chain, ranges};
  const auto add = [&](std::uint32_t begin, std::uint32_t end) {
    begin = std::max(begin, ranges.empty() ? 0u : ranges.back().end);
    if (begin < std::min(end, n)) ranges.push_back({begin, std::min(end, n)});
  };
  add(0, 1), add(n / 3, n / 3 + 3), add(std::bit_ceil(n) / 2 - 1, std::bit_ceil(n) / 2 + 1), add(n - 1, n);
  std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
  for (const SphereRange& range : ranges)
    for (std::uint32_t i = range.begin; i < range.end; ++i) spheres[i] = chain[(i + n / 2) % n];
  return {chain.moved(std::move(spheres)), ranges};
}

}  // namespace catena::properties

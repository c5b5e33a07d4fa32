#pragma once
#include "catena/core/chain/chain.h"

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

}  // namespace catena::properties

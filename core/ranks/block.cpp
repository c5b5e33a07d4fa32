#include "catena/core/ranks/block.h"

#include <hwy/highway.h>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena::ranks {

std::uint64_t blocks_of(std::span<const Piece> pieces) {
  std::uint64_t blocks = 0;
  for (const Piece& piece : pieces) blocks += (std::uint64_t{piece.size} + Block::most - 1) / Block::most;
  return blocks;
}

Box box_around(std::span<const Sphere> spheres) {
#if HWY_TARGET == HWY_SCALAR
  Box box = Box::around(spheres[0]);
  for (const Sphere& s : spheres.subspan(1)) box.join(Box::around(s));
  return box;
#else
  // Moving outward by what a rounding may have lost is monotone, so the box of the least and the greatest ends will do.
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::FixedTag<float, 4> four;
  auto low = hn::Set(four, CentreCorners::infinity), high = hn::Neg(low);
  for (const Sphere& s : spheres) {
    const auto sphere = hn::LoadU(four, &s.x), radius = hn::Broadcast<3>(sphere);
    low = hn::Min(low, hn::Sub(sphere, radius));
    high = hn::Max(high, hn::Add(sphere, radius));
  }
  const auto step = hn::Set(four, 0x1p-23f);
  float ends[8];
  hn::StoreU(hn::Sub(low, hn::Mul(hn::Abs(low), step)), four, ends);
  hn::StoreU(hn::Add(high, hn::Mul(hn::Abs(high), step)), four, ends + 4);
  return {{ends[0], ends[1], ends[2]}, {ends[4], ends[5], ends[6]}};
#endif
}

}  // namespace catena::ranks

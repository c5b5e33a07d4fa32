#include "catena/core/ranks/block.h"

#include <hwy/highway.h>

namespace catena::ranks {

std::uint64_t blocks_of(std::span<const Piece> pieces) {
  std::uint64_t blocks = 0;
  for (const Piece& piece : pieces) blocks += (std::uint64_t{piece.size} + Block::most - 1) / Block::most;
  return blocks;
}

namespace {

#if HWY_TARGET == HWY_SCALAR
Box around(std::span<const Sphere> spheres) {
  Box box = Box::around(spheres[0]);
  for (const Sphere& s : spheres.subspan(1)) box.join(Box::around(s));
  return box;
}
#else
namespace hn = hwy::HWY_NAMESPACE;

/// Moving outward by what a rounding may have lost is monotone, so the box of the least and the greatest ends will do.
inline Box around(std::span<const Sphere> spheres) {
  const hn::FixedTag<float, 4> four;
  using Ends = hn::Vec<decltype(four)>;
  const auto sphere = [&](std::size_t k) { return hn::LoadU(four, &spheres[k].x); };
  const auto lowest = [](Ends s) { return hn::Sub(s, hn::Broadcast<3>(s)); };
  const auto highest = [](Ends s) { return hn::Add(s, hn::Broadcast<3>(s)); };
  // Two at a time, as each minimum waits for the one before.
  const std::size_t last = spheres.size() - 1;
  Ends low = lowest(sphere(0)), high = highest(sphere(0));
  Ends other_low = lowest(sphere(last)), other_high = highest(sphere(last));
  std::size_t k = 1;
  for (; k + 1 < spheres.size(); k += 2) {
    const Ends a = sphere(k), b = sphere(k + 1);
    low = hn::Min(low, lowest(a)), high = hn::Max(high, highest(a));
    other_low = hn::Min(other_low, lowest(b)), other_high = hn::Max(other_high, highest(b));
  }
  low = hn::Min(low, other_low), high = hn::Max(high, other_high);
  const auto step = hn::Set(four, 0x1p-23f);
  float ends[8];
  hn::StoreU(hn::Sub(low, hn::Mul(hn::Abs(low), step)), four, ends);
  hn::StoreU(hn::Add(high, hn::Mul(hn::Abs(high), step)), four, ends + 4);
  return {{ends[0], ends[1], ends[2]}, {ends[4], ends[5], ends[6]}};
}
#endif

}  // namespace

Box box_around(std::span<const Sphere> spheres) { return around(spheres); }

LargeVector<Box> boxes_of(std::span<const Piece> pieces, std::span<const Sphere> spheres) {
  LargeVector<Box> boxes(blocks_of(pieces));
  Box* to = boxes.data();
  for_each_block(pieces, [&](const Block& block) { *to++ = around(spheres.subspan(block.begin, block.size)); });
  return boxes;
}

}  // namespace catena::ranks

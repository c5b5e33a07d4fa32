#include "catena/core/ranks/block.h"

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

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
bool any_in(std::span<const Sphere> spheres, const Box& box) {
  return std::ranges::any_of(spheres, [&](const Sphere& s) { return Box::around(s).meets(box); });
}
#else
namespace hn = hwy::HWY_NAMESPACE;
constexpr hn::FixedTag<float, 4> four;
using Four = hn::Vec<hn::FixedTag<float, 4> >;

/// The ends of a sphere along each axis, and something in the fourth lane.
Four low_of(Four sphere) { return hn::Sub(sphere, hn::Broadcast<3>(sphere)); }
Four high_of(Four sphere) { return hn::Add(sphere, hn::Broadcast<3>(sphere)); }
/// Moved by what a rounding may have lost; see Box::around.
Four lower(Four low) { return hn::Sub(low, hn::Mul(hn::Abs(low), hn::Set(four, 0x1p-23f))); }
Four higher(Four high) { return hn::Add(high, hn::Mul(hn::Abs(high), hn::Set(four, 0x1p-23f))); }

/// Moving is monotone, so the box of the least and the greatest ends will do.
Box around(std::span<const Sphere> spheres) {
  const auto sphere = [&](std::size_t k) { return hn::LoadU(four, &spheres[k].x); };
  // Two at a time, as each minimum waits for the one before.
  const Four first = sphere(0), last = sphere(spheres.size() - 1);
  Four low = low_of(first), high = high_of(first), other_low = low_of(last), other_high = high_of(last);
  for (std::size_t k = 1; k + 1 < spheres.size(); k += 2) {
    const Four a = sphere(k), b = sphere(k + 1);
    low = hn::Min(low, low_of(a)), high = hn::Max(high, high_of(a));
    other_low = hn::Min(other_low, low_of(b)), other_high = hn::Max(other_high, high_of(b));
  }
  float ends[8];
  hn::StoreU(lower(hn::Min(low, other_low)), four, ends);
  hn::StoreU(higher(hn::Max(high, other_high)), four, ends + 4);
  return {{ends[0], ends[1], ends[2]}, {ends[4], ends[5], ends[6]}};
}

bool any_in(std::span<const Sphere> spheres, const Box& box) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const float lows[] = {box.low[0], box.low[1], box.low[2], -infinity};
  const float highs[] = {box.high[0], box.high[1], box.high[2], infinity};
  const Four low = hn::LoadU(four, lows), high = hn::LoadU(four, highs);
  for (const Sphere& s : spheres) {
    const Four sphere = hn::LoadU(four, &s.x);
    const auto meets = hn::And(hn::Le(lower(low_of(sphere)), high), hn::Le(low, higher(high_of(sphere))));
    if (hn::AllTrue(four, meets)) return true;
  }
  return false;
}
#endif

}  // namespace

Box box_around(std::span<const Sphere> spheres) { return around(spheres); }

bool any_meets(std::span<const Sphere> spheres, const Box& box) { return any_in(spheres, box); }

LargeVector<Box> boxes_of(std::span<const Piece> pieces, std::span<const Sphere> spheres) {
  LargeVector<Box> boxes(blocks_of(pieces));
  Box* to = boxes.data();
  for_each_block(pieces,
                 [&](const Block& block) { *to++ = around(spheres.subspan(block.begin, block.size)); });
  return boxes;
}

}  // namespace catena::ranks

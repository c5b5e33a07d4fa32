#include "catena/core/cells/node_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "catena/core/cells/host_warp.h"

namespace catena {
namespace {

constexpr std::uint32_t lanes = HostOctet::lanes;

/// The directions of a path that goes back and forth, off the axes of space.
struct Sheet {
  Vector32 along{0.36f, 0.48f, 0.8f}, across{0.8f, -0.6f, 0};
  Vector32 at(float x, float y) const { return plus(plus({50, 20, -30}, x, along), y, across); }
};

/// A way of 200, of radius 1.
BlockCapsule lane(const Sheet& sheet, float x, float y) {
  const Vector32 half{100 * sheet.along.x, 100 * sheet.along.y, 100 * sheet.along.z};
  return {sheet.at(x, y), 1, half, 101};
}

NodeBox around(const std::function<BlockCapsule(std::uint32_t)>& at) {
  return NodeFit(HostOctet(), at).box();
}

std::array<float, 3> sides_of(const NodeBox& box) {
  std::array<float, 3> sides{box.half[0], box.half[1], box.half[2]};
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Where the middles of children lie says little of how a node lies: in a row across it, or aslant, as ways
/// back and forth leave them that are about as long as a child.
TEST(NodeBox, LiesAlongItsChildrenWhereverTheirMiddlesAre) {
  const Sheet sheet;
  for (const float slant : {0.0f, 0.5f, 1.5f, -3.0f}) {
    const auto middle = [&](std::uint32_t k) { return slant * 2 * static_cast<float>(k); };
    const auto at = [&](std::uint32_t k) { return lane(sheet, middle(k), 2 * static_cast<float>(k)); };
    const auto sides = sides_of(around(at));
    EXPECT_LT(sides[0], 1.1f) << slant;
    EXPECT_LT(sides[1], 14) << slant;  // half of 14, radius, and what their slant adds
    EXPECT_LT(sides[2], 103 + std::fabs(middle(7)) / 2) << slant;

    const auto box_at = [&](std::uint32_t n) {  // eight such nodes beside one another, aslant as well
      return around([&](std::uint32_t k) {
        const float row = static_cast<float>(n * lanes + k);
        return lane(sheet, slant * 2 * row, 2 * row);
      });
    };
    const auto of_nodes = sides_of(NodeFit(HostOctet(), box_at).box());
    EXPECT_LT(of_nodes[0], 1.2f) << slant;
    EXPECT_LT(of_nodes[1] * of_nodes[2], 1.8f * 64 * (100 + 64 * std::fabs(slant))) << slant;
  }
}

}  // namespace
}  // namespace catena

#include "catena/core/hierarchy/cell_tree.h"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace catena {
namespace {

/// Of a + b the greatest number of binary64 that is no greater; by Knuth's two_sum, which tells the sign of
/// what was rounded away.
double sum_below(double a, double b) {
  const double sum = a + b, b_part = sum - a;
  const double error = (a - (sum - b_part)) + (b - b_part);
  return error < 0 ? std::nextafter(sum, -std::numeric_limits<double>::infinity()) : sum;
}

Box64 around(const Sphere& s) {
  const double r = s.radius;
  return {{sum_below(s.x, -r), sum_below(s.y, -r), sum_below(s.z, -r)},
          {-sum_below(-s.x, -r), -sum_below(-s.y, -r), -sum_below(-s.z, -r)}};
}

/// In the order of the numbers, two apart, and beyond all cells that are near.
std::int64_t far_place(float v) {
  const auto bits = std::int64_t{std::bit_cast<std::int32_t>(v) & 0x7FFFFFFF};
  const std::int64_t beyond = (std::int64_t{1} << 40) + 2 * bits;
  return v < 0 ? -beyond : beyond;
}

}  // namespace

CellPlace CellPlace::of(const Sphere& s, double cells_per_unit, double far) {
  const auto along = [&](float v) {
    const double at = double{v} * cells_per_unit;
    return std::abs(at) < far ? static_cast<std::int64_t>(std::floor(at)) : far_place(v);
  };
  return {{along(s.x), along(s.y), along(s.z)}};
}

CellTree::CellTree(const ChainView& chain, std::vector<Member> members, std::uint32_t first_id)
    : members_(std::move(members)), end_id_(first_id), tree_(cells(chain), end_id_) {}

std::vector<CellTree::Node> CellTree::cells(const ChainView& chain) {
  std::ranges::sort(members_, [](const Member& a, const Member& b) {
    return std::pair(a.place.at, a.sphere) < std::pair(b.place.at, b.sphere);
  });
  std::vector<Node> cells;
  for (std::uint32_t m = 0; m < members_.size(); ++m) {
    const Box64 box = around(chain.spheres[members_[m].sphere]);
    if (m == 0 || members_[m].place != members_[m - 1].place)
      cells.push_back({CellRange::of(members_[m].place), box, members_[m].sphere, m, m});
    ++cells.back().end;
    RangeTree<CellRange>::join(cells.back().box, box);
  }
  for (Node& cell : cells)
    if (cell.end - cell.first > 1) cell.id = end_id_++;
  return cells;
}

void CellTree::show(BoundsVisitor& visitor) const {
  for (const Node& node : tree_.nodes()) {
    const auto edge = [&](std::uint32_t child, const AnyBound& bound) {
      visitor.edge(node.id, node.box, child, bound);
    };
    if (!node.is_leaf()) {
      for (const Node* child : {&tree_.children(node).first, &tree_.children(node).second})
        edge(child->id, child->end - child->first == 1 && child->is_leaf() ? AnyBound(Everything{})
                                                                           : AnyBound(child->box));
    } else if (node.end - node.first > 1) {
      for_each_in(node, [&](std::uint32_t i) { edge(i, Everything{}); });
    }
  }
}

}  // namespace catena

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
void join(Box64& box, const Box64& other) {
  box.low = {std::min(box.low.x, other.low.x), std::min(box.low.y, other.low.y),
             std::min(box.low.z, other.low.z)};
  box.high = {std::max(box.high.x, other.high.x), std::max(box.high.y, other.high.y),
              std::max(box.high.z, other.high.z)};
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

/// Of the build, and its spheres.
struct CellTree::Cell {
  CellPlace place;
  std::uint32_t first, end;  ///< members, by cells
};

CellTree::CellTree(const ChainView& chain, std::vector<Member> members, std::uint32_t first_id)
    : chain_(chain), members_(std::move(members)), end_id_(first_id) {
  if (members_.empty()) return;
  std::ranges::sort(members_, [](const Member& a, const Member& b) {
    return std::pair(a.place.at, a.sphere) < std::pair(b.place.at, b.sphere);
  });
  std::vector<Cell> cells;
  for (std::uint32_t m = 0; m < members_.size(); ++m) {
    if (m == 0 || members_[m].place != cells.back().place) cells.push_back({members_[m].place, m, m});
    ++cells.back().end;
  }
  nodes_.reserve(2 * cells.size());
  make(cells, 0, static_cast<std::uint32_t>(cells.size()));
}

/// A node of these cells, which are parted across the longest side of what they fill.
void CellTree::make(std::vector<Cell>& cells, std::uint32_t begin, std::uint32_t end) {
  if (end - begin == 1) return nodes_.push_back(leaf(cells[begin]));
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  CellRange range = CellRange::of(cells[begin].place);
  for (std::uint32_t k = begin + 1; k < end; ++k) range.join(CellRange::of(cells[k].place));
  std::size_t axis = 0;
  const auto side = [&](std::size_t d) { return range.high.at[d] - range.low.at[d]; };
  for (std::size_t d = 1; d < 3; ++d)
    if (side(d) > side(axis)) axis = d;
  const std::int64_t middle = range.low.at[axis] + side(axis) / 2;
  const auto second = std::partition(cells.begin() + begin, cells.begin() + end,
                                     [&](const Cell& cell) { return cell.place.at[axis] <= middle; });
  const auto parted = static_cast<std::uint32_t>(second - cells.begin());
  nodes_.push_back({range, {}, end_id_++, 0, 0, 0});
  make(cells, begin, parted);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  make(cells, parted, end);
  nodes_[at].box = nodes_[at + 1].box;
  join(nodes_[at].box, nodes_[nodes_[at].right].box);
}

CellTree::Node CellTree::leaf(const Cell& cell) {
  const bool alone = cell.end - cell.first == 1;
  const auto sphere = [&](std::uint32_t m) { return chain_.spheres[members_[m].sphere]; };
  Node node{CellRange::of(cell.place),
            around(sphere(cell.first)),
            alone ? members_[cell.first].sphere : end_id_++,
            cell.first,
            cell.end,
            0};
  for (std::uint32_t m = cell.first + 1; m < cell.end; ++m) join(node.box, around(sphere(m)));
  return node;
}

void CellTree::show(BoundsVisitor& visitor) const {
  for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
    const Node& node = nodes_[k];
    const auto edge = [&](std::uint32_t child, const AnyBound& bound) {
      visitor.edge(node.id, node.box, child, bound);
    };
    if (node.right != 0) {
      for (const std::uint32_t c : {k + 1, node.right}) {
        const Node& child = nodes_[c];
        edge(child.id, child.id < chain_.size ? AnyBound(Everything{}) : AnyBound(child.box));
      }
    } else if (node.end - node.first > 1) {
      for (std::uint32_t m = node.first; m < node.end; ++m) edge(members_[m].sphere, Everything{});
    }
  }
}

}  // namespace catena

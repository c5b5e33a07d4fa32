#include "catena/bench/pivot/pivot_walk.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "catena/core/error.h"

namespace catena::bench {
namespace {

LatticePoint straight(std::uint32_t steps) { return {static_cast<std::int32_t>(steps), 0, 0}; }

/// From one step on the straight walk to another.
WalkTree::Lanes between(std::uint32_t first, std::uint32_t last) {
  return {static_cast<std::int32_t>(first), 0, 0, 0, -static_cast<std::int32_t>(last), 0, 0, 0};
}

}  // namespace

PivotWalk::PivotWalk(std::uint32_t points) {
  if (points < 2 || points > 1u << 30)
    throw InputError(fmt::format("a walk has 2 to 2^30 points, not {}", points));
  static_cast<PivotHeap&>(tree_) = PivotHeap(points);
  const std::uint32_t leaves = tree_.leaves;
  tree_.near.resize(points);
  for (std::uint32_t leaf = leaves; leaf < 2 * leaves; ++leaf)
    for (std::uint32_t p = tree_.first_point(leaf); p < tree_.first_point(leaf + 1); ++p)
      tree_.near[p] = {static_cast<std::int8_t>(p - tree_.first_point(leaf) + 1), 0, 0, 0};
  tree_.halves.resize(leaves);
  for (std::uint32_t node = 1; node < leaves; ++node) {
    const std::uint32_t begin = tree_.first_below(2 * node), middle = tree_.first_below(2 * node + 1) - begin,
                        end = tree_.end_below(node) - begin;
    tree_.halves[node] = {between(1, middle), between(middle + 1, end)};
    tree_.halves[node].set(straight(middle), {});
  }
  tree_.end = straight(points);
}

std::size_t PivotWalk::bytes() const {
  return sizeof *this + tree_.halves.capacity() * sizeof(WalkTree::Halves) +
         tree_.near.capacity() * sizeof(WalkTree::NearPoint);
}

bool PivotWalk::attempt(std::span<const Pivot> pivots) {
  return pivots.size() == 1 ? attempt(pivots.front()) : bench::attempt(tree_, pivots);
}

LatticePoint PivotWalk::end_to_end() const { return tree_.end - straight(1); }

std::vector<LatticePoint> PivotWalk::points() const {
  std::vector<LatticePoint> points;
  points.reserve(size());
  std::vector<std::pair<std::uint32_t, LatticeMove>> open{{1, {{}, LatticePoint{} - straight(1)}}};
  while (!open.empty()) {
    const auto [node, at] = open.back();
    open.pop_back();
    if (tree_.is_leaf(node)) {
      for (std::uint32_t p = tree_.first_point(node); p < tree_.first_point(node + 1); ++p)
        points.push_back(at(LatticePoint{tree_.near[p].x, tree_.near[p].y, tree_.near[p].z}));
    } else {
      const WalkTree::Halves& halves = tree_.halves[node];
      open.push_back({2 * node + 1, {at.turn.after(halves.later_turn()), at(halves.earlier_end())}});
      open.push_back({2 * node, at});
    }
  }
  return points;
}

Chain PivotWalk::chain(float radius) const {
  const auto exact = [](std::int32_t v) {
    if (std::abs(v) > 1 << 24)
      throw InputError(
          fmt::format("a coordinate of the walk is {}, beyond the whole numbers of binary32", v));
    return static_cast<float>(v);
  };
  std::vector<Sphere> spheres;
  spheres.reserve(size());
  for (const LatticePoint& p : points()) spheres.push_back({exact(p.x), exact(p.y), exact(p.z), radius});
  return Chain(std::move(spheres));
}

}  // namespace catena::bench

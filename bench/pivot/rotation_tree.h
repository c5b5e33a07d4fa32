#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "catena/bench/pivot/pivot_heap.h"
#include "catena/bench/pivot/rotation.h"
#include "catena/core/sphere.h"

namespace catena::bench {

/// One move: every sphere after `site` is turned about its centre.
struct RotationPivot {
  std::uint32_t site;  ///< 0 to spheres - 2
  Rotation turn;
};

/// The steps of a move that a mutant of the tests replaces.
struct RotationRule {
  static Rotation seen_from(const RigidMove& at, const Rotation& turn) {
    return at.turn.inverse().after(turn).after(at.turn);
  }
  static CentreBall renewed(const CentreBall&, const CentreBall& now) {
    return now;
  }                                                              ///< a bound after a move
  static double skin(double rounding) { return 16 * rounding; }  ///< of the list of near pairs
  static double reach(double diameter, double skin, double rounding) { return diameter + skin + rounding; }
  static bool keeps(double distance, double most) { return distance <= most; }  ///< in that list
};

/// A chain under rotations in binary64: WalkTree's tree, with balls and quaternions for boxes and symmetries.
///
/// What sphere i is, is what is written of it: the moves of the nodes on its way are composed from the root
/// down, the result moves the point that its leaf holds, and each coordinate is rounded to the nearest
/// binary32. `sphere(i)` alone, the whole chain and the search of a move all compute just that, so they agree
/// to the bit.
template <class Rule = RotationRule>
struct RotationTree : PivotHeap {
  /// The two halves of a part of the chain, both as the node sees them: from the point before it.
  struct Halves {
    CentreBall earlier, later;
    Vec3 earlier_end, end;  ///< the last points of the earlier half and of both
    Rotation later_turn;
  };
  /// What a move changes, as it was.
  struct Saved {
    std::array<Halves, most_levels> halves;
    std::array<Vec3, most_in_leaf> near;
  };

  RigidMove from_start;
  float radius;
  std::vector<Halves> halves;  ///< of inner nodes
  std::vector<Vec3> near;      ///< the points of a leaf as it sees them

  /// A straight chain along x with steps of 1.
  RotationTree(std::uint32_t spheres, float all_radii, const Vec3& start)
      : PivotHeap(spheres),
        from_start{{}, start - Vec3{1, 0, 0}},
        radius(all_radii),
        halves(leaves),
        near(spheres) {
    for (std::uint32_t leaf = leaves; leaf < 2 * leaves; ++leaf)
      for (std::uint32_t p = first_point(leaf); p < first_point(leaf + 1); ++p)
        near[p] = {p - first_point(leaf) + 1.0, 0, 0};
    for (std::uint32_t node = leaves; node-- > 1;) {
      Halves& h = halves[node];
      h.earlier_end = end_of(2 * node);
      h.earlier = ball_of(2 * node);
      const RigidMove to_later{h.later_turn, h.earlier_end};
      h.later = ball_of(2 * node + 1).moved(to_later);
      h.end = to_later(end_of(2 * node + 1));
    }
  }

  /// Bytes of its state.
  std::size_t bytes() const {
    return sizeof *this + halves.capacity() * sizeof(Halves) + near.capacity() * sizeof(Vec3);
  }

  RigidMove at_later(std::uint32_t node, const RigidMove& at) const {
    return {at.turn.after(halves[node].later_turn), at(halves[node].earlier_end)};
  }
  RigidMove at_leaf(std::uint32_t leaf) const {
    RigidMove at = from_start;
    for (std::size_t level = 1; level < levels(); ++level)
      if (on_way(leaf, level) % 2 == 1) at = at_later(on_way(leaf, level - 1), at);
    return at;
  }
  Sphere written(const Vec3& p) const {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), radius};
  }
  Sphere sphere(std::uint32_t i) const { return written(at_leaf(leaf_of(i))(near[i])); }
  std::vector<Sphere> spheres() const {
    std::vector<Sphere> spheres;
    spheres.reserve(size);
    append(1, from_start, spheres);
    return spheres;
  }

  /// Of a node, as it sees itself.
  Vec3 end_of(std::uint32_t node) const {
    return is_leaf(node) ? near[first_point(node + 1) - 1] : halves[node].end;
  }
  CentreBall ball_of(std::uint32_t node) const {
    if (is_leaf(node)) return ball_about(first_point(node), first_point(node + 1));
    return join(halves[node].earlier, halves[node].later);
  }
  /// Of points begin .. end - 1 of a leaf, at least one.
  CentreBall ball_about(std::uint32_t begin, std::uint32_t end) const {
    Vec3 low = near[begin], high = low;
    for (std::uint32_t p = begin + 1; p < end; ++p) {
      low = {std::min(low.x, near[p].x), std::min(low.y, near[p].y), std::min(low.z, near[p].z)};
      high = {std::max(high.x, near[p].x), std::max(high.y, near[p].y), std::max(high.z, near[p].z)};
    }
    CentreBall ball{0.5 * (low + high)};
    for (std::uint32_t p = begin; p < end; ++p)
      ball.radius = std::max(ball.radius, length(near[p] - ball.centre));
    return ball;
  }
  /// No coordinate of the chain is beyond it.
  double extent() const {
    const CentreBall all = ball_of(1).moved(from_start);
    return std::max({std::fabs(all.centre.x), std::fabs(all.centre.y), std::fabs(all.centre.z)}) +
           all.radius + 1;
  }

  Saved save(std::uint32_t site) const {
    Saved saved;
    const std::uint32_t leaf = leaf_of(site), first = first_point(leaf);
    for (std::size_t level = 0; level + 1 < levels(); ++level)
      saved.halves[level] = halves[on_way(leaf, level)];
    std::copy(near.begin() + first, near.begin() + first_point(leaf + 1), saved.near.begin());
    return saved;
  }
  void restore(std::uint32_t site, const Saved& saved) {
    const std::uint32_t leaf = leaf_of(site), first = first_point(leaf);
    for (std::size_t level = 0; level + 1 < levels(); ++level)
      halves[on_way(leaf, level)] = saved.halves[level];
    std::copy_n(saved.near.begin(), first_point(leaf + 1) - first, near.begin() + first);
  }

  /// Makes the move, whatever then collides. What is before the site keeps its bits.
  void turn(const RotationPivot& pivot) {
    const std::uint32_t leaf = leaf_of(pivot.site);
    std::array<RigidMove, most_levels> at;
    at[0] = from_start;
    for (std::size_t level = 1; level < levels(); ++level)
      at[level] =
          on_way(leaf, level) % 2 == 1 ? at_later(on_way(leaf, level - 1), at[level - 1]) : at[level - 1];

    const Rotation in_leaf = Rule::seen_from(at[levels() - 1], pivot.turn);
    const Vec3 centre = near[pivot.site];
    for (std::uint32_t p = pivot.site + 1; p < first_point(leaf + 1); ++p)
      near[p] = centre + in_leaf(near[p] - centre);
    for (std::size_t level = levels() - 1; level-- > 0;) {
      const std::uint32_t node = on_way(leaf, level), below = on_way(leaf, level + 1);
      Halves& h = halves[node];
      if (below % 2 == 0) {  // the whole later half turns
        h.later_turn = Rule::seen_from(at[level], pivot.turn).after(h.later_turn).normalised();
        h.earlier_end = end_of(below);
        h.earlier = Rule::renewed(h.earlier, ball_of(below));
      }
      const RigidMove to_later{h.later_turn, h.earlier_end};
      h.later = Rule::renewed(h.later, ball_of(2 * node + 1).moved(to_later));
      h.end = to_later(end_of(2 * node + 1));
    }
  }

 private:
  void append(std::uint32_t node, const RigidMove& at, std::vector<Sphere>& spheres) const {
    if (is_leaf(node)) {
      for (std::uint32_t p = first_point(node); p < first_point(node + 1); ++p)
        spheres.push_back(written(at(near[p])));
      return;
    }
    append(2 * node, at, spheres);
    append(2 * node + 1, at_later(node, at), spheres);
  }
};

}  // namespace catena::bench

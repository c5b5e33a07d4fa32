#pragma once
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <vector>

#include "catena/bench/pivot/rotation_tree.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/chain/chain.h"
#include "catena/core/error.h"

namespace catena::bench {

/// A chain of equal spheres, steps of 1, under pivots by any rotation. The answer to an attempt is what the
/// exact predicate says of the spheres written in binary32 (RotationTree): yes, if after the move no two of
/// them that are not neighbours (window 1) collide.
///
/// A rotation rounds. So it can bring together two spheres that it turns alike, and what was free of
/// collisions before the move tells only of spheres that do not move. With E the extent and u = 2^-53:
/// - Rounding to binary32 moves a coordinate by no more than 2^-24 E, the distance of two spheres by less
/// than
///   2 sqrt(3) 2^-24 E < `rounding` = 2^-22 E.
/// - A place composed down d <= 31 levels is wrong by the sum over levels k of what k products of quaternions
/// and one
///   rotation make of a step of at most 2E: by less than 2^17 u E. A move changes the distance of two spheres
///   that it turns alike by four such errors and by the rounding of what it stores, less than as much again:
///   by less than `drift` = 2^-33 E. The balls are wrong by less than that, too, as each is joined anew from
///   those below. properties/proofs/rotation_binary64.g has the proof.
/// - A list holds every pair nearer than 2 radius + skin when it was made or when last a pivot was between
/// them. While
///   the drifts since are less than skin - rounding, no pair out of the list can collide by turning alike;
///   the pairs in it that could are decided on the written spheres. Else all pairs are listed, and decided,
///   anew.
/// Between what moves and what does not the tree is searched; two nodes are left alone when their balls are
/// further apart than 2 radius + skin + rounding, and rounding outweighs what rounding made of the balls.
///
/// O(log n) and the search; the list holds about n skin pairs, which grows as n^1.6. 44 to 72 bytes a sphere.
template <class Rule = RotationRule>
class RotatedChain {
 public:
  static constexpr std::uint32_t most_spheres = 1u << 22;

  /// A straight chain along x from `start` on. Throws InputError unless it has 2 to 2^22 spheres, and a
  /// radius from 0 to below 1 by which it does not collide as it is.
  explicit RotatedChain(std::uint32_t spheres, float radius = 0.5f, const Vec3& start = {})
      : tree_(checked(spheres), radius, start), diameter_(2.0 * static_cast<double>(radius)) {
    if (!(radius >= 0 && radius < 1) || !list_all())
      throw InputError(fmt::format(
          "a straight chain with steps of 1 collides or makes no sense with spheres of radius {}", radius));
  }

  std::uint32_t size() const { return tree_.size; }
  std::size_t bytes() const { return tree_.bytes() + near_.capacity() * sizeof(NearPair); }
  std::size_t near_pairs() const { return near_.size(); }
  const RotationTree<Rule>& tree() const { return tree_; }
  Chain chain() const { return Chain(tree_.spheres()); }
  Vec3 end_to_end() const { return tree_.end_of(1) - Vec3{1, 0, 0}; }

  /// Makes the move where no two spheres then collide; otherwise leaves every bit as it was and says false.
  bool attempt(const RotationPivot& pivot) {
    const double before = tree_.extent();
    const auto saved = tree_.save(pivot.site);
    tree_.turn(pivot);
    const double extent = tree_.extent(), drift = drift_ + drift_of(std::max(before, extent));
    if (drift + rounding_of(extent) >= skin_) {
      if (list_all()) return true;
    } else if (!meets_across(pivot.site, drift) && !moved_pair_collides(pivot.site, drift)) {
      std::erase_if(near_, [&](const NearPair& p) { return p.i <= pivot.site && pivot.site < p.j; });
      near_.insert(near_.end(), found_.begin(), found_.end());
      drift_ = drift;
      if (4 * extent < listed_extent_)
        list_all();  // a list for a chain as long as it was is too long for this one
      return true;
    }
    tree_.restore(pivot.site, saved);
    return false;
  }

 private:
  /// Two spheres, no neighbours. Their distance is at least `least` less the drift so far.
  struct NearPair {
    std::uint32_t i, j;
    double least;
  };
  /// Spheres where they are in space: all below a node, or some of a leaf's.
  struct Part {
    std::uint32_t node;
    std::uint32_t begin, end;  ///< read of a leaf only
    RigidMove at;
    CentreBall ball;
  };

  static std::uint32_t checked(std::uint32_t spheres) {
    if (spheres < 2 || spheres > most_spheres)
      throw InputError(
          fmt::format("a chain under rotations has 2 to {} spheres, not {}", most_spheres, spheres));
    return spheres;
  }
  static double rounding_of(double extent) { return 0x1p-22 * extent; }
  static double drift_of(double extent) { return 0x1p-33 * extent; }

  Part part(std::uint32_t node, const RigidMove& at, const CentreBall& seen_by_parent) const {
    if (!tree_.is_leaf(node)) return {node, 0, 0, at, seen_by_parent};
    return {node, tree_.first_point(node), tree_.first_point(node + 1), at, seen_by_parent};
  }
  Part earlier(std::uint32_t node, const RigidMove& at) const {
    return part(2 * node, at, tree_.halves[node].earlier.moved(at));
  }
  Part later(std::uint32_t node, const RigidMove& at) const {
    return part(2 * node + 1, tree_.at_later(node, at), tree_.halves[node].later.moved(at));
  }
  Part some_of(std::uint32_t leaf, std::uint32_t begin, std::uint32_t end, const RigidMove& at) const {
    return {leaf, begin, end, at, tree_.ball_about(begin, end).moved(at)};
  }

  void start_search(double drift, double skin) {
    found_.clear();
    search_drift_ = drift, search_skin_ = skin, rounding_ = rounding_of(tree_.extent());
    reach_ = Rule::reach(diameter_, skin, rounding_);
  }

  /// Lists all pairs anew. Says false, and leaves the list as it was, if some collide.
  bool list_all() {
    const double extent = tree_.extent(), skin = Rule::skin(rounding_of(extent));
    start_search(0, skin);
    if (meets_itself(part(1, tree_.from_start, {}))) return false;
    near_ = found_;
    drift_ = 0, skin_ = skin, listed_extent_ = extent;
    return true;
  }

  bool meets_itself(const Part& whole) {
    if (tree_.is_leaf(whole.node)) {
      for (std::uint32_t j = whole.begin + 1; j < whole.end; ++j)
        for (std::uint32_t i = whole.begin; i < j; ++i)
          if (collide(i, whole.at(tree_.near[i]), j, whole.at(tree_.near[j]))) return true;
      return false;
    }
    const Part before = earlier(whole.node, whole.at), after = later(whole.node, whole.at);
    return meets_itself(before) || meets_itself(after) || meet(before, after);
  }

  /// Spheres to the site and beyond it, nearest to it first.
  bool meets_across(std::uint32_t site, double drift) {
    start_search(drift, skin_);
    const std::uint32_t leaf = tree_.leaf_of(site), first = tree_.first_point(leaf),
                        beyond = tree_.first_point(leaf + 1);
    const std::size_t levels = tree_.levels();
    std::array<RigidMove, PivotHeap::most_levels> at;
    at[0] = tree_.from_start;
    for (std::size_t level = 1; level < levels; ++level)
      at[level] = tree_.on_way(leaf, level) % 2 == 1
                      ? tree_.at_later(tree_.on_way(leaf, level - 1), at[level - 1])
                      : at[level - 1];
    std::array<Part, PivotHeap::most_levels> before, after;
    std::size_t befores = 0, afters = 0;
    before[befores++] = some_of(leaf, first, site + 1, at[levels - 1]);
    if (site + 1 < beyond) {
      after[afters++] = some_of(leaf, site + 1, beyond, at[levels - 1]);
      if (meet(before[0], after[0])) return true;
    }
    for (std::size_t level = levels - 1; level-- > 0;) {
      const std::uint32_t node = tree_.on_way(leaf, level);
      if (tree_.on_way(leaf, level + 1) % 2 == 0) {
        const Part& added = after[afters++] = later(node, at[level]);
        for (std::size_t k = 0; k < befores; ++k)
          if (meet(before[k], added)) return true;
      } else {
        const Part& added = before[befores++] = earlier(node, at[level]);
        for (std::size_t k = 0; k < afters; ++k)
          if (meet(added, after[k])) return true;
      }
    }
    return false;
  }

  bool meet(const Part& before, const Part& after) {
    const Vec3 way = after.ball.centre - before.ball.centre;
    const double far = before.ball.radius + after.ball.radius + reach_;
    if (dot(way, way) > far * far) return false;
    const bool one = tree_.is_leaf(before.node), other = tree_.is_leaf(after.node);
    if (one && other) {
      for (std::uint32_t i = before.begin; i < before.end; ++i) {
        const Vec3 at = before.at(tree_.near[i]);
        for (std::uint32_t j = after.begin; j < after.end; ++j)
          if (collide(i, at, j, after.at(tree_.near[j]))) return true;
      }
      return false;
    }
    if (other || (!one && before.node <= after.node))
      return meet(later(before.node, before.at), after) || meet(earlier(before.node, before.at), after);
    return meet(before, earlier(after.node, after.at)) || meet(before, later(after.node, after.at));
  }

  /// i < j, and where they are; lists them if they are near.
  bool collide(std::uint32_t i, const Vec3& at_i, std::uint32_t j, const Vec3& at_j) {
    if (j - i <= 1) return false;
    const double distance = length(at_j - at_i);
    if (!Rule::keeps(distance, diameter_ + search_skin_)) return false;
    if (distance <= diameter_ + rounding_ && Robust::overlap(tree_.written(at_i), tree_.written(at_j)))
      return true;
    found_.push_back({i, j, distance + search_drift_});
    return false;
  }

  /// Does a pair of the list of which both have moved.
  bool moved_pair_collides(std::uint32_t site, double drift) const {
    for (const NearPair& p : near_)
      if (p.i > site && p.least - drift <= diameter_ + rounding_ &&
          Robust::overlap(tree_.sphere(p.i), tree_.sphere(p.j)))
        return true;
    return false;
  }

  RotationTree<Rule> tree_;
  double diameter_;
  std::vector<NearPair> near_, found_;
  double drift_ = 0, skin_ = 0, listed_extent_ = 0;
  double search_drift_ = 0, search_skin_ = 0, rounding_ = 0, reach_ = 0;  ///< of the search under way
};

}  // namespace catena::bench

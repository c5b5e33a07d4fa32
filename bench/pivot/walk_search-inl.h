// Attempts of pivots. Compiled once a target: no include guard but Highway's.
#if defined(CATENA_BENCH_PIVOT_WALK_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_BENCH_PIVOT_WALK_SEARCH_INL_H
#undef CATENA_BENCH_PIVOT_WALK_SEARCH_INL_H
#else
#define CATENA_BENCH_PIVOT_WALK_SEARCH_INL_H
#endif

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "catena/bench/pivot/lattice_lanes-inl.h"
#include "catena/bench/pivot/walk_tree.h"

HWY_BEFORE_NAMESPACE();
namespace catena::bench::HWY_NAMESPACE {

class WalkSearch {
 public:
  explicit WalkSearch(WalkTree& tree) : tree_(tree) {}

  bool attempt(const Pivot& pivot) {
    const Cut cut(tree_, pivot.site);
    if (meets_about(cut, pivot.turn)) return false;
    turn(cut, pivot.turn);
    return true;
  }

  bool attempt(std::span<const Pivot> pivots) {
    for (const Pivot& pivot : pivots) turn(Cut(tree_, pivot.site), pivot.turn);
    std::vector<Pivot> sorted(pivots.begin(), pivots.end());
    std::ranges::sort(sorted, {}, &Pivot::site);
    if (!meets_itself(Part{LatticeLanes::point_of({}), 1, 0, tree_.size, from_origin()}, sorted)) return true;
    for (std::size_t k = pivots.size(); k-- > 0;) turn(Cut(tree_, pivots[k].site), pivots[k].turn.inverse());
    return false;
  }

 private:
  using Move = LatticeLanesMove;
  using Halves = WalkTree::Halves;

  /// Points of the walk where they are in space: all below a node, or some of a leaf's.
  struct Part {
    LatticeLanes box;
    std::uint32_t node;
    std::uint32_t begin, end;  ///< read of a leaf only
    Move at;
  };

  /// So that the first point of the walk, one step on, is the origin.
  static HWY_INLINE Move from_origin() { return Move{{}, LatticeLanes::point_of({-1, 0, 0})}; }
  static HWY_INLINE Move at_later(const Halves& halves, const Move& at) {
    return {at.turn.after(halves.later_turn()), at(LatticeLanes::earlier_end(halves))};
  }
  /// How a turn looks from there.
  static HWY_INLINE LatticeSymmetry seen_from(const Move& at, LatticeSymmetry turn) {
    return at.turn.inverse().after(turn).after(at.turn);
  }

  /// The way from the root to the leaf that has the last point before the cut.
  struct Cut {
    std::uint32_t site, leaf;
    std::size_t levels;
    LatticeLanes centre;                         ///< of the turn: the last point before the cut
    std::array<Move, WalkTree::most_levels> at;  ///< of the nodes on the way, the root's first

    HWY_INLINE Cut(const WalkTree& tree, std::uint32_t before)
        : site(before), leaf(tree.leaf_of(before)), levels(tree.levels()) {
      // The way is known from the site: its cache misses need not queue.
      __builtin_prefetch(&tree.near[site]);
      for (std::size_t level = levels - 1; level-- > 0;) __builtin_prefetch(&tree.halves[node(level)]);
      at[0] = from_origin();
      for (std::size_t level = 1; level < levels; ++level)
        at[level] =
            goes_later(level - 1) ? at_later(tree.halves[node(level - 1)], at[level - 1]) : at[level - 1];
      centre = at[levels - 1](LatticeLanes::point(tree.near[site]));
    }
    std::uint32_t node(std::size_t level) const { return leaf >> (levels - 1 - level); }
    bool goes_later(std::size_t level) const { return node(level + 1) % 2 == 1; }  ///< from this level down
    const Move& at_leaf() const { return at[levels - 1]; }
  };

  HWY_INLINE Part part(std::uint32_t node, const LatticeLanes& box, const Move& at) const {
    if (tree_.is_leaf(node)) return {box, node, tree_.first_point(node), tree_.first_point(node + 1), at};
    return {box, node, 0, 0, at};
  }
  HWY_INLINE Part later(std::uint32_t node, const LatticeLanes& box, const Move& at) const {
    return part(2 * node + 1, box, at_later(tree_.halves[node], at));
  }
  /// Points begin .. end - 1 of a leaf, at least one.
  HWY_INLINE Part some_of(std::uint32_t leaf, std::uint32_t begin, std::uint32_t end, const Move& at) const {
    LatticeLanes box = LatticeLanes::point(tree_.near[begin]);
    for (std::uint32_t p = begin + 1; p < end; ++p) box = join(box, LatticeLanes::point(tree_.near[p]));
    return {at(box), leaf, begin, end, at};
  }
  /// A search will soon read it.
  HWY_INLINE void fetch(std::uint32_t node) const {
    if (tree_.is_leaf(node))
      __builtin_prefetch(&tree_.near[tree_.first_point(node)]);
    else
      __builtin_prefetch(&tree_.halves[node]);
  }

  /// A point of one is a point of the other; their boxes meet. What is nearest to where the two join is
  /// looked at first: a walk that meets itself mostly does so there.
  bool meet(const Part& before, const Part& after) const {
    const bool one = tree_.is_leaf(before.node), other = tree_.is_leaf(after.node);
    if (one && other) return points_meet(before, after);
    if (other || (!one && before.node <= after.node)) {
      const Halves& halves = tree_.halves[before.node];
      const LatticeLanes earlier_box = before.at(LatticeLanes::load(halves.earlier));
      const LatticeLanes later_box = before.at(LatticeLanes::load(halves.later));
      const bool in_earlier = !apart(earlier_box, after.box), in_later = !apart(later_box, after.box);
      if (in_later) fetch(2 * before.node + 1);
      if (in_earlier) fetch(2 * before.node);
      return (in_later && meet(later(before.node, later_box, before.at), after)) ||
             (in_earlier && meet(part(2 * before.node, earlier_box, before.at), after));
    }
    const Halves& halves = tree_.halves[after.node];
    const LatticeLanes earlier_box = after.at(LatticeLanes::load(halves.earlier));
    const LatticeLanes later_box = after.at(LatticeLanes::load(halves.later));
    const bool in_earlier = !apart(before.box, earlier_box), in_later = !apart(before.box, later_box);
    if (in_earlier) fetch(2 * after.node);
    if (in_later) fetch(2 * after.node + 1);
    return (in_earlier && meet(before, part(2 * after.node, earlier_box, after.at))) ||
           (in_later && meet(before, later(after.node, later_box, after.at)));
  }

  bool points_meet(const Part& before, const Part& after) const {
    std::array<LatticeLanes, WalkTree::most_in_leaf> inside;
    std::size_t count = 0;
    for (std::uint32_t p = before.begin; p < before.end; ++p) {
      const LatticeLanes at = before.at(LatticeLanes::point(tree_.near[p]));
      if (!apart(at, after.box)) inside[count++] = at;
    }
    if (count == 0) return false;
    for (std::uint32_t p = after.begin; p < after.end; ++p) {
      const LatticeLanes at = after.at(LatticeLanes::point(tree_.near[p]));
      for (std::size_t k = 0; k < count; ++k)
        if (!apart(inside[k], at)) return true;
    }
    return false;
  }

  /// Would the walk, turned so after the cut.
  bool meets_about(const Cut& cut, LatticeSymmetry turn) const {
    const Move about_centre{turn, cut.centre - cut.centre.turned(turn)};
    std::array<Part, WalkTree::most_levels> before, after;  // nearest to the pivot first
    std::size_t befores = 0, afters = 0;
    const std::uint32_t first = tree_.first_point(cut.leaf), beyond = tree_.first_point(cut.leaf + 1);
    before[befores++] = some_of(cut.leaf, first, cut.site + 1, cut.at_leaf());
    if (cut.site + 1 < beyond) {
      after[afters++] = some_of(cut.leaf, cut.site + 1, beyond, about_centre.after(cut.at_leaf()));
      if (!apart(before[0].box, after[0].box) && points_meet(before[0], after[0])) return true;
    }
    // What each level adds, from the leaf up, against the other side so far.
    for (std::size_t level = cut.levels - 1; level-- > 0;) {
      const std::uint32_t node = cut.node(level);
      const Halves& halves = tree_.halves[node];
      if (!cut.goes_later(level)) {
        const Move at = about_centre.after(cut.at[level]);
        const Part& added = after[afters++] = later(node, at(LatticeLanes::load(halves.later)), at);
        for (std::size_t k = 0; k < befores; ++k)
          if (!apart(before[k].box, added.box) && meet(before[k], added)) return true;
      } else {
        const Move& at = cut.at[level];
        const Part& added = before[befores++] = part(2 * node, at(LatticeLanes::load(halves.earlier)), at);
        for (std::size_t k = 0; k < afters; ++k)
          if (!apart(added.box, after[k].box) && meet(added, after[k])) return true;
      }
    }
    return false;
  }

  /// Turns everything after the cut about the last point before it.
  void turn(const Cut& cut, LatticeSymmetry turn) {
    std::array<LatticeLanes, WalkTree::most_levels>
        end;  // of the nodes on the way, as they are before the turn
    end[0] = LatticeLanes::point_of(tree_.end);
    for (std::size_t level = 0; level + 1 < cut.levels; ++level) {
      const Halves& halves = tree_.halves[cut.node(level)];
      const LatticeLanes earlier_end = LatticeLanes::earlier_end(halves);
      end[level + 1] = cut.goes_later(level)
                           ? (end[level] - earlier_end).turned(halves.later_turn().inverse())
                           : earlier_end;
    }

    const LatticeSymmetry in_leaf = seen_from(cut.at_leaf(), turn);
    const LatticeLanes centre = LatticeLanes::point(tree_.near[cut.site]);
    const std::uint32_t beyond = tree_.first_point(cut.leaf + 1);
    for (std::uint32_t p = cut.site + 1; p < beyond; ++p) {
      const LatticePoint at = (centre + (LatticeLanes::point(tree_.near[p]) - centre).turned(in_leaf)).low();
      tree_.near[p] = {static_cast<std::int8_t>(at.x), static_cast<std::int8_t>(at.y),
                       static_cast<std::int8_t>(at.z), 0};
    }

    LatticeLanes box =
        some_of(cut.leaf, tree_.first_point(cut.leaf), beyond, Move{{}, LatticeLanes::point_of({})}).box;
    LatticeLanes now = LatticeLanes::point(tree_.near[beyond - 1]);
    for (std::size_t level = cut.levels - 1; level-- > 0;) {
      Halves& halves = tree_.halves[cut.node(level)];
      LatticeLanes earlier_box = LatticeLanes::load(halves.earlier),
                   later_box = LatticeLanes::load(halves.later);
      const LatticeLanes old_end = LatticeLanes::earlier_end(halves);
      LatticeSymmetry later_turn = halves.later_turn();
      LatticeLanes earlier_end = old_end;
      if (cut.goes_later(level)) {
        later_box = box.turned(later_turn) + old_end;
        now = now.turned(later_turn) + old_end;
      } else {  // the whole later half turns
        const LatticeSymmetry seen = seen_from(cut.at[level], turn);
        later_turn = seen.after(later_turn);
        earlier_box = box, earlier_end = now;
        later_box = (later_box - old_end).turned(seen) + earlier_end;
        now = (end[level] - old_end).turned(seen) + earlier_end;
      }
      earlier_box.store(halves.earlier), later_box.store(halves.later);
      halves.set(earlier_end.low(), later_turn);
      box = join(earlier_box, later_box);
    }
    tree_.end = now.low();
  }

  /// Of these pivots, which lie between points of the part. A part without one is as it was, free of
  /// collisions.
  bool meets_itself(const Part& whole, std::span<const Pivot> sorted) const {
    if (sorted.empty()) return false;
    if (tree_.is_leaf(whole.node)) {
      for (std::uint32_t p = whole.begin + 1; p < whole.end; ++p)
        for (std::uint32_t q = whole.begin; q < p; ++q)
          if (!apart(LatticeLanes::point(tree_.near[p]), LatticeLanes::point(tree_.near[q]))) return true;
      return false;
    }
    const std::uint32_t middle = tree_.first_below(2 * whole.node + 1);
    const auto joining = std::ranges::lower_bound(sorted, middle - 1, {}, &Pivot::site);
    const auto beyond = std::ranges::lower_bound(sorted, middle, {}, &Pivot::site);
    const Halves& halves = tree_.halves[whole.node];
    const Part earlier_half = part(2 * whole.node, whole.at(LatticeLanes::load(halves.earlier)), whole.at);
    const Part later_half = later(whole.node, whole.at(LatticeLanes::load(halves.later)), whole.at);
    return meets_itself(earlier_half, {sorted.begin(), joining}) ||
           meets_itself(later_half, {beyond, sorted.end()}) ||
           (!apart(earlier_half.box, later_half.box) && meet(earlier_half, later_half));
  }

  WalkTree& tree_;
};

}  // namespace catena::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// What is near a block of a BlockTree, and what a search for it costs.
#if defined(CATENA_CORE_BLOCKS_NEAR_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_NEAR_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_NEAR_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_NEAR_BLOCKS_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <span>

#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/neighbour_blocks.h"
#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/chain/chain_view.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Those of the nodes below node k of level l that a box may meet: met(node), and look() before each look at
/// sixteen boxes, until one of them returns false.
template <class Met, class Look>
inline bool for_each_met_below(const BlockTree& tree, const OrientedBoxes& box, std::size_t l,
                               std::uint32_t k, const Met& met, const Look& look) {
  if (l == 0) return met(k);
  if (!look()) return false;
  std::uint32_t near = may_meet(box, OrientedBoxes::load(tree.level[l - 1].at(k * BlockTree::group))) &
                       lane_bits(tree.children_of(l, k));
  for (; near != 0; near &= near - 1) {
    const auto child = k * BlockTree::group + static_cast<std::uint32_t>(std::countr_zero(near));
    if (!for_each_met_below(tree, box, l - 1, child, met, look)) return false;
  }
  return true;
}
/// The nodes of level 0 that one of them may meet, itself among them.
template <class Met, class Look>
inline void for_each_met(const BlockTree& tree, std::uint32_t node, const Met& met, const Look& look) {
  auto box = OrientedBoxes::all(tree.level[0].at(node), node % BlockTree::group);
  for_each_met_below(tree, box, tree.level.size() - 1, 0, met, look);
}
template <class Met>
inline void for_each_met(const BlockTree& tree, std::uint32_t node, const Met& met) {
  for_each_met(tree, node, met, [] { return true; });
}

/// Halves that one pays of what it takes to meet another. Among some that are crowded, given or null, these
/// pay none: without it they would have done with the chain's order.
inline std::uint32_t pays(const Crowding* among, std::uint32_t node) {
  return among != nullptr && among->crowded(node) ? 2 : 1;
}

/// Counts the blocks whose capsules one may meet, in any order, as often as one pays for them, no further
/// than just past `enough`, but for those that hold its neighbours alone; the nodes that may hold some; the
/// rows, nodes of which some blocks may be met by their boxes; and the looks on the way to these.
class NearBlocks {
 public:
  NearBlocks(const ChainView& chain, const BlockTree& tree, std::uint32_t b, std::uint32_t enough,
             const Crowding* among = nullptr) {
    constexpr std::uint32_t group = BlockTree::group;
    const NeighbourBlocks neighbours(chain, tree);
    // Those beside it are taken off later.
    const auto passed_over = [&](std::uint32_t other) {
      return other < b ? other + 1 < b && neighbours.all(other, b)
                       : b + 1 < other && neighbours.all(b, other);
    };
    Capsules capsule = Capsules::all(tree.capsules_of(b / group), b % group);
    auto box = OrientedBoxes::all(tree.level[0].at(b / group), b / group % group);
    Intervals own = intervals(capsule, box.centre, box.axis);
    const auto met = [&](std::uint32_t node) {
      const std::uint32_t times = pays(among, node);
      Capsules theirs = Capsules::load(tree.capsules_of(node));
      std::uint32_t near =
          meet(own, intervals(theirs, box.centre, box.axis)) & lane_bits(tree.blocks_of(node));
      nodes_ += times;
      if (kept_ < most_kept) node_[kept_++] = node;
      if (near == 0) return true;
      rows_ += times;
      near = may_collide(capsule, theirs, near);
      if (neighbours.some())
        for_each_lane(near, [&](std::uint32_t k) {
          if (passed_over(node * group + k)) near &= ~(1u << k);
        });
      count_ += times * static_cast<std::uint32_t>(std::popcount(near));
      for (const std::uint32_t beside : {b - 1, b, b + 1})
        if (beside / group == node) own_ += times * (near >> beside % group & 1);
      return count_ <= enough;
    };
    for_each_met(tree, b / group, met, [&] { return ++looks_ != 0; });
    enough_ = count_ > enough;
    // Within a block, and with the next along the chain, all is searched, near or not, unless it is ordered.
    const auto searched = [&](std::uint32_t a, std::uint32_t next) {
      const bool ordered = (tree.ordered[a / group] >> a % group & 1) != 0;
      return !ordered && next < tree.blocks && !neighbours.all(a, next);
    };
    const bool before = b > 0 && searched(b - 1, b), after = searched(b, b + 1);
    const bool inside = (b == 0 || before) && after && !neighbours.all(b, b);
    beside_ = std::uint32_t{before} + after + 2 * inside;
  }
  bool enough() const { return enough_; }
  std::uint32_t count() const { return count_; }
  std::uint32_t nodes() const { return nodes_; }
  std::uint32_t rows() const { return rows_; }
  /// Halves that one pays for blocks that are near it, itself and those beside it along the chain among them;
  /// and for these alone.
  std::uint32_t halves() const { return count_ - own_ + beside_; }
  std::uint32_t halves_beside() const { return beside_; }
  std::uint32_t looks() const { return looks_; }
  /// The first of those nodes, enough of them.
  std::span<const std::uint32_t> some_nodes() const { return {node_.data(), kept_}; }

 private:
  static constexpr std::uint32_t most_kept = 128;
  std::array<std::uint32_t, most_kept> node_;
  std::uint32_t kept_ = 0;
  bool enough_;
  std::uint32_t beside_, own_ = 0, count_ = 0, nodes_ = 0, rows_ = 0, looks_ = 0;
};

/// What is near a sphere, about, each pair once.
struct SpheresAround {
  std::uint32_t candidates;  ///< that a search by cells compares with it
  double overlaps;           ///< how many overlap it
};
/// Of one in the middle of a block: half of those in a cube around it that is three diameters wide, the mean
/// of its own and the other's, and of a ball's share of those in one of two, in nodes that its own may meet;
/// told no further than just past `enough` candidates. `among` as for NearBlocks.
inline SpheresAround spheres_around(const ChainView& chain, const BlockTree& tree, std::uint32_t b,
                                    const NearBlocks& near_b, std::uint32_t enough, const Crowding* among) {
  constexpr std::uint32_t group = BlockTree::group;
  const std::uint32_t place = tree.size_of(b) / 2;
  const Sphere& middle = tree.spheres(chain, b)[place];
  constexpr float reach = 1.5f, nearly_to_corners = 2;
  Capsules cube = Capsules::all(tree.capsules_of(b / group), b % group);
  cube.radius = cube.radius + Lanes16::all(nearly_to_corners * middle.radius * tree.unit());
  std::uint32_t count = 0, beside = 0;
  for (const std::uint32_t node : near_b.some_nodes()) {
    Capsules theirs = Capsules::load(tree.capsules_of(node));
    theirs.radius = Lanes16::all(nearly_to_corners) * theirs.radius;
    const std::uint32_t times = pays(among, node),
                        those = may_collide(cube, theirs, lane_bits(tree.blocks_of(node)));
    for_each_lane(those, [&](std::uint32_t k) {
      const std::uint32_t other = node * group + k;
      const SphereLanes spheres(tree.spheres(chain, other));
      const std::uint32_t there = lane_bits(tree.size_of(other)),
                          within = spheres.centres_within(middle, reach) & there;
      if (within == 0) return;
      count += times * static_cast<std::uint32_t>(std::popcount(within));
      // Itself and the two beside it along the chain do not overlap it.
      const std::uint32_t others = other == b ? there & ~(7u << place >> 1) : there;
      beside += times * static_cast<std::uint32_t>(std::popcount(spheres.centres_within(middle, 1) & others));
    });
    if (count > 2 * enough) break;
  }
  constexpr double ball = std::numbers::pi / 6;
  return {count / 2, ball * beside / 2};
}

/// What it costs to search a sphere, about, on one core with AVX-512. Narrower vectors make it dearer to look
/// at sixteen at a time than to search by cells. Measured on chains of many kinds; a wrong figure costs time
/// and changes no answer.
struct SphereCost {
  static constexpr double sixteen = Lanes16::parts == 1 ? 1 : 1.25;  ///< times as dear are sixteen at a time
  /// Of a tree: two of each.
  static constexpr double near_ns = 12, row_ns = 21 * sixteen, node_ns = 45 * sixteen;
  static constexpr double beside_ns = 4 * sixteen;  ///< of a BlockRun: likewise
  static constexpr double look_ns = 36 * sixteen;   ///< at the boxes of sixteen nodes, likewise
  static constexpr double pair_ns = 1.5;            ///< of a tree: a sphere of two that overlap, among eight
  static constexpr double cells_ns = 23, test_ns = 6, cell_tests = 1;  ///< by cells: a sphere; sixteen others
  static constexpr double wide_ns = 16, wide_pair_ns = 3.5;  ///< by wide cells: a sphere; a candidate
  static constexpr double beyond_ns = 6;                     ///< an octave that cells leave the cache by
  static constexpr double tests = 1.2 / 16;  ///< a candidate, as cells end where vectors do not

  /// In the chain's order; each of two that are met pays one half.
  static double in_tree(const NearBlocks& near) {
    constexpr double block = BlockTree::block, node = block * BlockTree::group;
    const double near_alone = near.halves() - near.halves_beside();
    return ((near_alone * near_ns + near.halves_beside() * beside_ns + near.rows() * row_ns) / block +
            (near.nodes() * node_ns + near.looks() * look_ns) / node) /
           2;
  }
  /// And for the pairs that it finds: a sphere's with those of one block cost as one.
  static double of_pairs(const NearBlocks& near, double overlaps) {
    return pair_ns * std::min(overlaps, near.halves() / 2.0);
  }
  /// No more than so much, however many overlap.
  static double most_of_pairs(const NearBlocks& near) { return pair_ns * near.halves() / 2; }
  /// Looks that cost a node about as much as another that it meets.
  static constexpr std::uint32_t looks_a_node() {
    constexpr double usual_rows = 0.4 * BlockTree::group;
    return static_cast<std::uint32_t>((node_ns + usual_rows * row_ns) / look_ns);
  }
  /// `beyond` as octaves_beyond_cache() tells it.
  static double in_cells(std::uint32_t candidates, double beyond) {
    return beyond_ns * beyond +
           std::min(wide_ns + wide_pair_ns * candidates, narrow_ns + test_ns * tests * candidates);
  }
  /// So many candidates by which cells are no cheaper than that.
  static std::uint32_t candidates(double ns, double beyond) {
    const double all_ns = ns - beyond_ns * beyond;
    const double many = std::max((all_ns - narrow_ns) / (test_ns * tests), (all_ns - wide_ns) / wide_pair_ns);
    return static_cast<std::uint32_t>(std::clamp(many, 0.0, 1e6));
  }

 private:
  static constexpr double narrow_ns = cells_ns + test_ns * cell_tests;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

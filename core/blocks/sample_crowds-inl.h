// A look at some nodes of a BlockTree before all are walked.
#if defined(CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#undef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#else
#define CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <numbers>

#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/team.h"
#include "hwy/cache_control.h"

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
  const auto box = OrientedBoxes::all(tree.level[0].at(node), node % BlockTree::group);
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
/// than just past `enough`; the nodes that may hold some; and the looks on the way to these.
class NearBlocks {
 public:
  NearBlocks(const BlockTree& tree, std::uint32_t b, std::uint32_t enough, const Crowding* among = nullptr) {
    constexpr std::uint32_t group = BlockTree::group;
    const Capsules capsule = Capsules::all(tree.capsules_of(b / group), b % group);
    const auto met = [&](std::uint32_t node) {
      const std::uint32_t near = may_collide(capsule, Capsules::load(tree.capsules_of(node))),
                          times = pays(among, node);
      count_ += times * static_cast<std::uint32_t>(std::popcount(near & lane_bits(tree.blocks_of(node))));
      nodes_ += times;
      return count_ <= enough;
    };
    for_each_met(tree, b / group, met, [&] { return ++looks_ != 0; });
    enough_ = count_ > enough;
  }
  bool enough() const { return enough_; }
  std::uint32_t count() const { return count_; }
  std::uint32_t nodes() const { return nodes_; }
  std::uint32_t looks() const { return looks_; }

 private:
  bool enough_;
  std::uint32_t count_ = 0, nodes_ = 0, looks_ = 0;
};

/// About how many spheres a search by cells compares with one in the middle of a block, each pair once: half
/// of those in a cube around it that is three of its diameters wide; told no further than just past `enough`.
/// `among` as for NearBlocks.
inline std::uint32_t spheres_in_cells(const ChainView& chain, const BlockTree& tree, std::uint32_t b,
                                      std::uint32_t enough, const Crowding* among) {
  constexpr std::uint32_t group = BlockTree::group;
  const Sphere& middle = tree.spheres(chain, b)[tree.size_of(b) / 2];
  const float reach = 3 * middle.radius;
  Capsules cube = Capsules::all(tree.capsules_of(b / group), b % group);
  cube.radius = cube.radius + Lanes16::all(reach * tree.scale);
  std::uint32_t count = 0;
  for_each_met(tree, b / group, [&](std::uint32_t node) {
    const std::uint32_t near = may_collide(cube, Capsules::load(tree.capsules_of(node))),
                        times = pays(among, node), those = near & lane_bits(tree.blocks_of(node));
    for_each_lane(those, [&](std::uint32_t k) {
      const Sphere* const s = tree.spheres(chain, node * group + k);
      hwy::Prefetch(s), hwy::Prefetch(s + 4);
    });
    for_each_lane(those, [&](std::uint32_t k) {
      const std::uint32_t other = node * group + k;
      const std::uint32_t within = SphereLanes(tree.spheres(chain, other)).centres_within(middle, reach);
      count += times * static_cast<std::uint32_t>(std::popcount(within & lane_bits(tree.size_of(other))));
    });
    return count <= 2 * enough;
  });
  return count / 2;
}

/// What it costs to search a sphere, about, on one core with AVX-512. Measured on chains of many kinds; a
/// wrong figure costs time and changes no answer.
struct SphereCost {
  static constexpr double near_ns = 51, row_ns = 4, nodes_ns = 107;  ///< of a tree: two of each
  static constexpr double look_ns = 36;   ///< at the boxes of sixteen nodes, likewise
  static constexpr double pair_ns = 5.7;  ///< of a tree: a sphere of two that overlap, among eight
  static constexpr double cells_ns = 32, test_ns = 6, cell_tests = 1;  ///< by cells: a sphere; sixteen others
  static constexpr double tests = 1.5 / 16;  ///< a candidate, as cells end where vectors do not

  static constexpr double met_ns =
      row_ns / BlockTree::block + nodes_ns / (BlockTree::block * BlockTree::group);
  /// Overlaps, of so many candidates: those within a ball, of those in a cube.
  static constexpr double overlaps = 4.0 / 3 * std::numbers::pi / 27;

  /// In the chain's order, where a block meets so many, each of which pays one half. Of the nodes that meet a
  /// block's own it meets four of ten by their boxes; itself and those beside it along the chain it mostly
  /// need not look into.
  static double in_tree(const NearBlocks& near) {
    constexpr double block = BlockTree::block, node = block * BlockTree::group;
    constexpr std::uint32_t own = 3;
    const std::uint32_t others = near.count() - std::min(own, near.count());
    return (others * near_ns / block + near.nodes() * met_ns + near.looks() * look_ns / node) / 2;
  }
  /// And for the pairs that it finds: a sphere's with those of one block cost as one.
  static double of_pairs(const NearBlocks& near, std::uint32_t candidates) {
    return pair_ns * std::min(overlaps * candidates, near.count() / 2.0);
  }
  static double most_of_pairs(const NearBlocks& near) { return pair_ns * near.count() / 2; }
  /// Looks that cost a node about as much as another that it meets.
  static constexpr std::uint32_t looks_a_node() {
    return static_cast<std::uint32_t>(met_ns * BlockTree::block * BlockTree::group / look_ns);
  }
  static double in_cells(std::uint32_t candidates) {
    return cells_ns + test_ns * (cell_tests + tests * candidates);
  }
  /// So many candidates by which cells are no cheaper than that.
  static std::uint32_t candidates(double ns) {
    return static_cast<std::uint32_t>(std::clamp((ns - in_cells(0)) / (test_ns * tests), 0.0, 1e6));
  }
};

/// Of a chain, looks at some nodes, each of which stands for sixteen that follow one another: where it is
/// crowded, or one of its blocks meets so many others that its spheres are better met one by one, all are
/// taken to be.
class CrowdSample {
 public:
  CrowdSample(const ChainView& chain, const BlockTree& tree, std::uint32_t limit, Crowding& crowding,
              const Team& team)
      : chain_(chain), tree_(tree), limit_(limit), crowding_(crowding), team_(team) {}

  /// Looks at every sixteenth node; and where some are crowded, again at the rest, which may be better off
  /// with these than in an order that they alone are left in. A few that are left then are not worth it.
  void all() const {
    all(nullptr);
    if (!crowding_.some()) return;
    all(&crowding_);
    constexpr std::uint32_t few = 16;  // one in so many
    if (std::uint64_t{few} * (nodes() - crowding_.crowded_nodes()) > nodes()) return;
    for (std::uint32_t k = 0; k < nodes(); ++k) crowding_.crowd(k);
  }

  /// True when the chain's own order most likely serves all of it, so that looking at every sixteenth node
  /// would cost more than it can save: of a few nodes none is crowded. What is crowded all the same is met by
  /// the walk; and where that meets few pairs of nodes, what is near within them costs no more than in cells.
  bool sparse() const {
    constexpr std::uint32_t apart = 16;  // groups
    for (std::uint32_t g = std::min(apart, groups()) / 2; g < groups(); g += apart)
      if (crowded(g, nullptr)) return false;
    return true;
  }
  /// After the walk: it met so few that this stands.
  bool stayed_sparse() const { return crowding_.pair_count() <= std::size_t{4} * nodes(); }

 private:
  static constexpr std::uint32_t group = BlockTree::group;

  std::uint32_t nodes() const { return crowding_.nodes(); }
  std::uint32_t groups() const { return (nodes() + group - 1) / group; }

  void all(const Crowding* among) const {
    constexpr std::uint32_t groups_of_a_task = 16;
    team_.for_each_range(groups(), groups_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t g = begin; g < end; ++g)
        if (!(among != nullptr && among->crowded(middle(g))) && crowded(g, among))
          for (std::uint32_t k = g * group; k < std::min(nodes(), (g + 1) * group); ++k) crowding_.crowd(k);
    });
  }

  /// The node in the middle of group g.
  std::uint32_t middle(std::uint32_t g) const { return (g * group + std::min(nodes(), (g + 1) * group)) / 2; }
  /// Most likely all of group g are better off in another order. One block tells little where both would cost
  /// about the same, and a crowd with holes costs both: then more are asked.
  bool crowded(std::uint32_t g, const Crowding* among) const {
    const std::uint32_t first = g * group, size = std::min(nodes(), first + group) - first;
    Look all = look(first + size / 2, among);
    if (!all.even()) return all.crowded();
    for (const std::uint32_t k : {size / 6, 5 * size / 6}) {
      const Look one = look(first + k, among);
      all.tree_ns += one.tree_ns, all.cells_ns += one.cells_ns;
    }
    return all.crowded();
  }

  /// What a sphere costs, about, in the chain's order and in cells.
  struct Look {
    double tree_ns, cells_ns;
    bool crowded() const { return tree_ns > cells_ns; }
    bool even() const { return 2 * tree_ns < 3 * cells_ns && 2 * cells_ns < 3 * tree_ns; }
  };
  Look look(std::uint32_t node, const Crowding* among) const {
    constexpr std::uint32_t plenty = 256;
    const Look many{4 * SphereCost::in_cells(0), SphereCost::in_cells(0)};
    if (meets_many(node, among)) return many;
    const std::uint32_t b = tree_.some_block_of(node);
    const NearBlocks near(tree_, b, plenty, among);
    if (near.enough()) return many;
    // Not all of what is near is counted where that can make no difference.
    const double ns = SphereCost::in_tree(near), most = ns + SphereCost::most_of_pairs(near);
    if (most <= SphereCost::in_cells(0)) return {most, 2 * most};
    const std::uint32_t candidates = spheres_in_cells(
        chain_, tree_, b, SphereCost::candidates(among != nullptr ? 1.5 * most : most), among);
    return {ns + SphereCost::of_pairs(near, candidates), SphereCost::in_cells(candidates)};
  }
  /// More others than the limit, or as much is to be looked at on the way to them.
  bool meets_many(std::uint32_t node, const Crowding* among) const {
    constexpr std::uint64_t whole = SphereCost::looks_a_node();
    // Others, itself, and what leads to it.
    const std::uint64_t most = (std::uint64_t{limit_} + 1) * whole + tree_.level.size() - 1;
    std::uint64_t met = 0;
    const auto add = [&](std::uint64_t more) { return (met += more) <= most; };
    const auto others = [&](std::uint32_t k) { return add(pays(among, k) * whole); };
    for_each_met(tree_, node, others, [&] { return add(1); });
    return met > most;
  }

  const ChainView& chain_;
  const BlockTree& tree_;
  const std::uint32_t limit_;
  Crowding& crowding_;
  const Team& team_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// A look at some nodes of a BlockTree before all are walked.
#if defined(CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#undef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#else
#define CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#endif

#include <algorithm>
#include <bit>

#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/team.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Those of the nodes below node k of level l that a box may meet: met(node), until it returns false.
template <class Met>
inline bool for_each_met_below(const BlockTree& tree, const OrientedBoxes& box, std::size_t l,
                               std::uint32_t k, const Met& met) {
  if (l == 0) return met(k);
  std::uint32_t near = may_meet(box, OrientedBoxes::load(tree.level[l - 1].at(k * BlockTree::group))) &
                       lane_bits(tree.children_of(l, k));
  for (; near != 0; near &= near - 1) {
    const auto child = k * BlockTree::group + static_cast<std::uint32_t>(std::countr_zero(near));
    if (!for_each_met_below(tree, box, l - 1, child, met)) return false;
  }
  return true;
}
/// The nodes of level 0 that one of them may meet, itself among them.
template <class Met>
inline void for_each_met(const BlockTree& tree, std::uint32_t node, const Met& met) {
  const auto box = OrientedBoxes::all(tree.level[0].at(node), node % BlockTree::group);
  for_each_met_below(tree, box, tree.level.size() - 1, 0, met);
}

/// Counts the blocks whose capsules one may meet, in any order, no further than just past `enough`, and the
/// nodes that may hold some.
class NearBlocks {
 public:
  NearBlocks(const BlockTree& tree, std::uint32_t b, std::uint32_t enough) {
    constexpr std::uint32_t group = BlockTree::group;
    const Capsules capsule = Capsules::all(tree.capsules_of(b / group), b % group);
    for_each_met(tree, b / group, [&](std::uint32_t node) {
      const std::uint32_t near = may_collide(capsule, Capsules::load(tree.capsules_of(node)));
      count_ += static_cast<std::uint32_t>(std::popcount(near & lane_bits(tree.blocks_of(node))));
      ++nodes_;
      return count_ <= enough;
    });
    enough_ = count_ > enough;
  }
  bool enough() const { return enough_; }
  std::uint32_t count() const { return count_; }
  std::uint32_t nodes() const { return nodes_; }

 private:
  bool enough_;
  std::uint32_t count_ = 0, nodes_ = 0;
};

/// About how many spheres a search by cells compares with one in the middle of a block, each pair once: half
/// of those in a cube around it that is three of its diameters wide; told no further than just past `enough`.
inline std::uint32_t spheres_in_cells(const ChainView& chain, const BlockTree& tree, std::uint32_t b,
                                      std::uint32_t enough) {
  constexpr std::uint32_t group = BlockTree::group;
  const Sphere& middle = tree.spheres(chain, b)[tree.size_of(b) / 2];
  const float reach = 3 * middle.radius;
  Capsules cube = Capsules::all(tree.capsules_of(b / group), b % group);
  cube.radius = cube.radius + Lanes16::all(reach * tree.scale);
  std::uint32_t count = 0;
  for_each_met(tree, b / group, [&](std::uint32_t node) {
    const std::uint32_t near = may_collide(cube, Capsules::load(tree.capsules_of(node)));
    for_each_lane(near & lane_bits(tree.blocks_of(node)), [&](std::uint32_t k) {
      const std::uint32_t other = node * group + k;
      const std::uint32_t within = SphereLanes(tree.spheres(chain, other)).centres_within(middle, reach);
      count += static_cast<std::uint32_t>(std::popcount(within & lane_bits(tree.size_of(other))));
    });
    return count <= 2 * enough;
  });
  return count / 2;
}

/// What it costs to search a sphere, about, on one core with AVX-512, apart from the pairs that are found.
/// Measured on chains of many kinds; a wrong figure costs time and changes no answer.
struct SphereCost {
  static constexpr double near_ns = 28, row_ns = 4, nodes_ns = 32;     ///< of a tree: two of each
  static constexpr double cells_ns = 32, test_ns = 6, cell_tests = 1;  ///< by cells: a sphere; sixteen others
  static constexpr double tests = 1.5 / 16;  ///< a candidate, as cells end where vectors do not

  /// In the chain's order, where a block meets so many, each of which pays one half. Of the nodes that meet a
  /// block's own it meets four of ten by their boxes.
  static double in_tree(const NearBlocks& near) {
    constexpr double block = BlockTree::block, node = block * BlockTree::group;
    return (near.count() * near_ns / block + near.nodes() * (row_ns / block + nodes_ns / node)) / 2;
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

  /// Looks at every sixteenth node.
  void all() const {
    constexpr std::uint32_t groups_of_a_task = 16;
    team_.for_each_range(groups(), groups_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t g = begin; g < end; ++g)
        if (crowded(g))
          for (std::uint32_t k = g * group; k < std::min(nodes(), (g + 1) * group); ++k) crowding_.crowd(k);
    });
  }

  /// True when the chain's own order most likely serves all of it, so that looking at every sixteenth node
  /// would cost more than it can save: of a few nodes none is crowded. What is crowded all the same is met by
  /// the walk; and where that meets few pairs of nodes, what is near within them costs no more than in cells.
  bool sparse() const {
    constexpr std::uint32_t apart = 16;  // groups
    for (std::uint32_t g = std::min(apart, groups()) / 2; g < groups(); g += apart)
      if (crowded(g)) return false;
    return true;
  }
  /// After the walk: it met so few that this stands.
  bool stayed_sparse() const { return crowding_.pair_count() <= std::size_t{4} * nodes(); }

 private:
  static constexpr std::uint32_t group = BlockTree::group;

  std::uint32_t nodes() const { return crowding_.nodes(); }
  std::uint32_t groups() const { return (nodes() + group - 1) / group; }

  /// The node in the middle of group g.
  bool crowded(std::uint32_t g) const {
    constexpr std::uint32_t plenty = 256;
    const std::uint32_t first = g * group, node = (first + std::min(nodes(), first + group)) / 2;
    std::uint64_t met = 0;
    const std::uint64_t most = std::uint64_t{limit_} + 1;  // others, and itself
    for_each_met(tree_, node, [&](std::uint32_t) { return ++met <= most; });
    if (met > most) return true;
    const std::uint32_t b = tree_.some_block_of(node);
    const NearBlocks near(tree_, b, plenty);
    const double ns = SphereCost::in_tree(near);
    if (near.enough() || ns <= SphereCost::in_cells(0)) return near.enough();
    const std::uint32_t enough = SphereCost::candidates(ns);
    return spheres_in_cells(chain_, tree_, b, enough) < enough;
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

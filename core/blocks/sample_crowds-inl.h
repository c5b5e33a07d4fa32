// A look at some nodes of a BlockTree before all are walked.
#if defined(CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#undef CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#else
#define CATENA_CORE_BLOCKS_SAMPLE_CROWDS_INL_H
#endif

#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/blocks/tests-inl.h"
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

/// Counts the blocks whose capsules one may meet, in any order, no further than just past `enough`.
class NearBlocks {
 public:
  NearBlocks(const BlockTree& tree, std::uint32_t b, std::uint32_t enough)
      : tree_(tree), enough_(enough), capsule_(Capsules::all(tree.capsules_of(b / group), b % group)) {
    for_each_met(tree, b / group, [&](std::uint32_t node) {
      const std::uint32_t near = may_collide(capsule_, Capsules::load(tree_.capsules_of(node)));
      count_ += static_cast<std::uint32_t>(std::popcount(near & lane_bits(tree_.blocks_of(node))));
      return count_ <= enough_;
    });
  }
  bool enough() const { return count_ > enough_; }

 private:
  static constexpr std::uint32_t group = BlockTree::group;
  const BlockTree& tree_;
  const std::uint32_t enough_;
  const Capsules capsule_;
  std::uint32_t count_ = 0;
};

/// Of a chain, looks at some nodes, each of which stands for sixteen that follow one another: where it is
/// crowded, or one of its blocks meets so many others that its spheres may be better met one by one, all are
/// taken to be.
class CrowdSample {
 public:
  CrowdSample(const BlockTree& tree, std::uint32_t limit, Crowding& crowding, const Team& team)
      : tree_(tree), limit_(limit), crowding_(crowding), team_(team) {}

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
  /// would cost more than it can save: most blocks go straight on, and of a few nodes none is crowded.
  /// What is crowded all the same is met by the walk.
  bool sparse() const {
    constexpr std::uint32_t apart = 16;  // groups
    std::uint32_t ordered = 0;
    for (const std::uint16_t windows : tree_.ordered)
      ordered += static_cast<std::uint32_t>(std::popcount(windows));
    if (ordered < tree_.blocks / 2) return false;
    for (std::uint32_t g = std::min(apart, groups()) / 2; g < groups(); g += apart)
      if (crowded(g)) return false;
    return true;
  }
  /// After the walk: it met so few that this stands.
  bool stayed_sparse() const { return crowding_.pair_count() <= std::size_t{2} * nodes(); }

 private:
  static constexpr std::uint32_t group = BlockTree::group;

  std::uint32_t nodes() const { return crowding_.nodes(); }
  std::uint32_t groups() const { return (nodes() + group - 1) / group; }

  /// The node in the middle of group g.
  bool crowded(std::uint32_t g) const {
    constexpr std::uint32_t most_near = 24;
    const std::uint32_t first = g * group, node = (first + std::min(nodes(), first + group)) / 2;
    std::uint64_t met = 0;
    const std::uint64_t most = std::uint64_t{limit_} + 1;  // others, and itself
    for_each_met(tree_, node, [&](std::uint32_t) { return ++met <= most; });
    return met > most || NearBlocks(tree_, node * group + tree_.blocks_of(node) / 2, most_near).enough();
  }

  const BlockTree& tree_;
  const std::uint32_t limit_;
  Crowding& crowding_;
  const Team& team_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

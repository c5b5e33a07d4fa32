// Which crowded blocks are dense: where one sphere after another in cells of space is the cheaper search.
#if defined(CATENA_CORE_SPACE_TREE_JUDGE_DENSITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_JUDGE_DENSITY_INL_H
#undef CATENA_CORE_SPACE_TREE_JUDGE_DENSITY_INL_H
#else
#define CATENA_CORE_SPACE_TREE_JUDGE_DENSITY_INL_H
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/near_blocks-inl.h"
#include "catena/core/space_tree/search_cost.h"
#include "catena/core/space_tree/search_space_tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// True when most of some crowded blocks, taken all along the chain, meet so many others that no order of
/// blocks would do: then a second search for the rest is not worth its while. `block_ns` is what a search of
/// their spheres one by one costs a block, for which so many `pairs` overlap. Where nodes meet very many,
/// fewer blocks are looked at: all together no more nodes, about, than there are.
inline bool mostly_dense(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                         double block_ns, double pairs) {
  constexpr std::uint32_t most = 32, fewest = 5, apart = 13;  // of which some are all along the chain too
  const double search_ns = block_ns - SpaceCost::build_ns;
  // Each of two blocks that are near pays one half.
  const auto enough = static_cast<std::uint32_t>(
      std::max(0.0, SpaceCost::near_in(2 * search_ns * SpaceCost::near_share, 2 * pairs)));
  std::array<std::uint32_t, most> nodes;
  const std::uint32_t samples = std::min(most, crowding.crowded_nodes());
  const std::uint32_t step = std::max(1u, crowding.crowded_nodes() / samples);
  for (std::uint32_t node = 0, crowded = 0, found = 0; node < crowding.nodes() && found < samples; ++node)
    if (crowding.crowded(node) && crowded++ % step == 0) nodes[found++] = node;
  std::uint32_t looked = 0, dense = 0;
  for (std::uint64_t met = 0; looked < samples && (looked < fewest || met < crowding.nodes()); ++looked) {
    const std::uint32_t which = samples == most ? looked * apart % most : looked;
    const NearBlocks near(chain, tree, tree.some_block_of(nodes[which]), enough);
    met += near.nodes();
    dense += near.enough();
  }
  return 2 * dense >= looked;
}

/// What a node of a SpaceTree costs, told no further than just past `enough`.
class SpaceSample {
 public:
  /// `pairs` of spheres overlap, about, for each node.
  SpaceSample(const ChainView& chain, const BlockTree& tree, const SpaceTree& space, double enough_ns,
              double pairs)
      : space_(space), neighbours_(chain, tree), enough_ns_(enough_ns), pairs_(pairs) {}
  bool skip(std::uint32_t a, std::uint32_t b) { return cost_.nodes += shares(a, b), enough(); }
  void take(std::span<const Pair> entries) {
    for (const Pair& pair : entries) cost_.entries += shares(pair.i / group, pair.j / group);
    for_each_near(
        space_, entries,
        [&](std::uint32_t a, std::uint32_t b) {
          const auto [first, second] = blocks_of(space_, a, b);
          if (!neighbours_.all(first, second)) cost_.near += shares(a / group, b / group);
        },
        NoSpaceEvidence{});
  }
  bool enough() const { return cost_.ns(2 * pairs_) / 2 > enough_ns_; }

 private:
  static constexpr std::uint32_t group = SpaceTree::group;
  /// Halves: each of two nodes that meet pays one, and a node alone for what is within it.
  static std::uint64_t shares(std::uint32_t a, std::uint32_t b) { return a == b ? 2 : 1; }

  const SpaceTree& space_;
  const NeighbourBlocks neighbours_;
  const double enough_ns_, pairs_;
  SpaceCost cost_;
};

/// Looks at one node of sixteen, and judges all by it; where most are dense after all, all are. `block_ns`
/// and `pairs` as for mostly_dense.
inline void judge_density(const ChainView& chain, const BlockTree& tree, SpaceTree& space, Crowding& crowding,
                          std::span<SpaceQueue> queues, double block_ns, double pairs, const Team& team) {
  constexpr std::uint32_t group = SpaceTree::group, judged_at_once = 16, judged_by_a_task = 8,
                          nodes_of_a_task = 64;
  for (std::uint32_t node = 0; node < crowding.nodes(); ++node) crowding.dense(node) = 0;
  std::atomic<std::uint32_t> dense = 0;
  const auto judge = [&](std::uint32_t first) {
    const std::uint32_t end = std::min(space.nodes(), first + judged_at_once);
    SpaceSample sample(chain, tree, space, block_ns * group, pairs * group);
    const NoSpaceEvidence nothing;
    SpaceWalk walk(space, queues[team.member()], sample, nothing);
    walk.node((first + end) / 2, true);
    walk.finish();
    if (!sample.enough()) return;
    dense += end - first;
    for (std::uint32_t k = first * group; k < std::min(space.entries, end * group); ++k)
      crowding.make_dense(space.whole[k] / group, space.whole[k] % group);
  };
  team.for_each_range((space.nodes() + judged_at_once - 1) / judged_at_once, judged_by_a_task,
                      [&](std::uint32_t begin, std::uint32_t end) {
                        for (std::uint32_t k = begin; k < end; ++k) judge(k * judged_at_once);
                      });
  if (dense > space.nodes() / 2) {
    crowding.all_dense();
    space.entries = 0;
    return;
  }
  space.dense_entry.resize(space.entries);
  space.dense_node.resize(space.nodes());
  team.for_each_range(space.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t node = begin; node < end; ++node) {
      std::uint8_t all = 1;
      for (std::uint32_t k = node * group; k < std::min(space.entries, (node + 1) * group); ++k)
        all &= space.dense_entry[k] = crowding.dense(space.whole[k] / group) >> space.whole[k] % group & 1;
      space.dense_node[node] = all;
    }
  });
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

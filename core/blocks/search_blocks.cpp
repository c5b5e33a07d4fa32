// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/blocks/search_blocks.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <iterator>
#include <utility>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/blocks/sample_crowds-inl.h"
#include "catena/core/blocks/search_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// What a walk asks for.
struct CrowdWalk {
  Crowding& crowding;
  const Team* team;     ///< null: one thread
  CrowdSample* sample;  ///< looks again once the walk has met many; null: not
  void met(std::uint32_t a, std::uint32_t b) {
    crowding.met(a, b, team != nullptr ? team->member() : 0);
    if (sample != nullptr && !sample->stayed_sparse()) std::exchange(sample, nullptr)->all(false);
  }
  bool left_out(std::size_t l, std::uint32_t a, std::uint32_t b) const { return crowding.left_out(l, a, b); }
  bool left_out_group(std::size_t l, std::uint32_t a, std::uint32_t parent) const {
    return crowding.left_out_group(l, a, parent);
  }
  bool stop() const { return false; }
};

void find_crowds_here(const ChainView& chain, const BlockTree& tree, std::uint32_t limit, Crowding& crowding,
                      const Team& team) {
  if (tree.blocks == 0) return;
  CrowdSample sample(chain, tree, limit, crowding, team);
  const bool sparse = sample.sparse();
  if (!sparse) sample.all(false);
  if (sample.cheap()) crowding.set_limit(2 * limit);
  // Amid the walk, what turns out to be crowded is left out of the rest of it. Of few nodes the rest is
  // little, and after it less is to be asked; several threads walk at once.
  const bool alone = team.size() == 1, amid = sparse && alone && !sample.few_nodes();
  CrowdWalk walk{crowding, alone ? nullptr : &team, amid ? &sample : nullptr};
  if (alone)
    NodeWalk(tree, walk, NoBlockEvidence{}).run();
  else
    NodeWalk(tree, walk, NoBlockEvidence{}, ByTeam{team}).run();
  if (sparse && !amid && !sample.stayed_sparse()) sample.all(true);
}

void search_nodes_here(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                       std::uint32_t begin, std::uint32_t end, BlockQueues& queues,
                       PairCollector::Lane& lane) {
  BlockSearch<NoBlockEvidence> search(chain, tree, queues, lane, {});
  search.run_nodes(crowding, begin, end);
  search.finish();
}
void search_pairs_here(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                       std::span<const Pair> nodes, BlockQueues& queues, PairCollector::Lane& lane) {
  BlockSearch<NoBlockEvidence> search(chain, tree, queues, lane, {});
  search.run_pairs(crowding, nodes);
  search.finish();
}
void search_alone_here(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                       BlockQueues& queues, PairCollector::Lane& lane) {
  BlockSearch<NoBlockEvidence> search(chain, tree, queues, lane, {});
  search.run_nodes(crowding, 0, crowding.nodes());
  search.run_pairs(crowding, crowding.pairs().front());
  search.finish();
}

/// Gathers the pairs of nodes that a walk with evidence meets: of those that the walk before met, whose
/// crowding was not yet known, those that are not left out now.
struct NearWalk {
  const Crowding& crowding;
  std::vector<Pair>& near;
  void met(std::uint32_t a, std::uint32_t b) const { near.push_back({a, b}); }
  bool left_out(std::size_t l, std::uint32_t a, std::uint32_t b) const { return crowding.left_out(l, a, b); }
  bool left_out_group(std::size_t l, std::uint32_t a, std::uint32_t parent) const {
    return crowding.left_out_group(l, a, parent);
  }
  bool stop() const { return false; }
};

void search_uncrowded_here(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                           BlockQueues& queues, PairCollector::Lane& lane, const BlockEvidence& evidence) {
  if (tree.blocks == 0) return;
  std::vector<Pair> near, known;
  const NearWalk walk{crowding, near};
  NodeWalk(tree, walk, evidence).run();
  std::ranges::sort(near);
  for (const std::vector<Pair>& pairs : crowding.pairs())
    std::ranges::copy_if(pairs, std::back_inserter(known),
                         [&](const Pair& nodes) { return std::ranges::binary_search(near, nodes); });
  BlockSearch<BlockEvidence> search(chain, tree, queues, lane, evidence);
  search.run_nodes(crowding, 0, crowding.nodes());
  search.run_pairs(crowding, known);
  search.finish();
}

void search_here(const ChainView& chain, const BlockTree& tree, BlockQueues& queues,
                 PairCollector::Lane& lane, const BlockEvidence* evidence) {
  if (evidence != nullptr)
    BlockSearch<BlockEvidence>(chain, tree, queues, lane, *evidence).run();
  else
    BlockSearch<NoBlockEvidence>(chain, tree, queues, lane, {}).run();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {
namespace {

/// Enough for some ten microseconds.
constexpr std::uint32_t nodes_of_a_task = 32, pairs_of_a_task = 64;

}  // namespace

HWY_EXPORT(find_crowds_here);
HWY_EXPORT(search_nodes_here);
HWY_EXPORT(search_pairs_here);
HWY_EXPORT(search_uncrowded_here);
HWY_EXPORT(search_alone_here);
HWY_EXPORT(search_here);

void find_crowds(const ChainView& chain, const BlockTree& tree, std::uint32_t limit, Crowding& crowding,
                 const Team& team) {
  crowding.reset(tree, limit, team.size());
  HWY_DYNAMIC_DISPATCH(find_crowds_here)(chain, tree, limit, crowding, team);
  crowding.all_dense();
}
void search_uncrowded(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                      std::span<BlockQueues> queues, PairCollector& collector, const Team& team) {
  if (team.size() == 1)
    return HWY_DYNAMIC_DISPATCH(search_alone_here)(chain, tree, crowding, queues[0], collector.lane(0));
  team.for_each_range(crowding.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    const unsigned member = team.member();
    HWY_DYNAMIC_DISPATCH(search_nodes_here)
    (chain, tree, crowding, begin, end, queues[member], collector.lane(member));
  });
  for (const std::vector<Pair>& pairs : crowding.pairs()) {
    team.for_each_range(static_cast<std::uint32_t>(pairs.size()), pairs_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          const unsigned member = team.member();
                          HWY_DYNAMIC_DISPATCH(search_pairs_here)
                          (chain, tree, crowding, std::span(pairs).subspan(begin, end - begin),
                           queues[member], collector.lane(member));
                        });
  }
}
void search_uncrowded(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                      BlockQueues& queues, PairCollector::Lane& lane, const BlockEvidence& evidence) {
  HWY_DYNAMIC_DISPATCH(search_uncrowded_here)(chain, tree, crowding, queues, lane, evidence);
}
void search_blocks(const ChainView& chain, const BlockTree& tree, BlockQueues& queues,
                   PairCollector::Lane& lane, const BlockEvidence* evidence) {
  HWY_DYNAMIC_DISPATCH(search_here)(chain, tree, queues, lane, evidence);
}

}  // namespace catena
#endif

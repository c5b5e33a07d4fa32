#include "catena/core/hybrid/hybrid_search.h"

#include <numeric>

namespace catena {

HybridSearch::HybridSearch(const Settings& settings, unsigned threads)
    : settings_(settings), block_queues_(threads), entry_queues_(threads), grid_queues_(threads) {}

void HybridSearch::build(const ChainView& chain, const Team& team) {
  build_block_tree(chain, tree_, team);
  if (!settings_.rows) tree_.forget_rows();
  find_crowds(chain, tree_, settings_.crowd, crowding_, team);
  space_.entries = 0;
  dense_.clear();
  dense_count_ = 0;
  if (crowding_.crowded_nodes() == 0) return;
  build_space_tree(chain, tree_, crowding_, space_, settings_.dense, entry_queues_, team);
  if (space_.entries == 0 && crowding_.crowded_nodes() == crowding_.nodes()) {
    dense_count_ = chain.size;  // their list need not be made
  } else {
    gather_dense(team);
    dense_count_ = static_cast<std::uint32_t>(dense_.size());
  }
  if (dense_count_ > 0) build_grid(chain, grid_, dense_, team);
}

void HybridSearch::search(const ChainView& chain, PairCollector& collector, const Team& team) {
  before_ = met();
  search_uncrowded(chain, tree_, crowding_, block_queues_, collector, team);
  if (space_.entries > 0)
    search_space_tree(chain, tree_, space_, entry_queues_, block_queues_, collector, team);
  if (dense_count_ > 0) search_grid(chain, grid_, grid_queues_, collector, team);
}

void HybridSearch::gather_dense(const Team& team) {
  // Counted first, so that each thread knows where its own come.
  const auto for_each = [&](std::uint32_t node, const auto& body) {
    const std::uint32_t begin = node * BlockTree::group, dense = crowding_.dense(node);
    for (std::uint32_t b = begin; dense != 0 && b < begin + tree_.blocks_of(node); ++b) {
      if ((dense >> (b - begin) & 1) == 0) continue;
      for (std::uint32_t k = 0; k < BlockTree::block; ++k)
        if (const std::uint32_t i = tree_.index(b, k); i != BlockTree::no_sphere) body(i);
    }
  };
  constexpr std::uint32_t nodes_of_a_task = 64;
  const auto for_each_node = [&](const auto& body) {
    team.for_each_range(crowding_.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t node = begin; node < end; ++node) body(node);
    });
  };
  dense_before_.assign(crowding_.nodes() + 1, 0);
  for_each_node(
      [&](std::uint32_t node) { for_each(node, [&](std::uint32_t) { ++dense_before_[node + 1]; }); });
  std::partial_sum(dense_before_.begin(), dense_before_.end(), dense_before_.begin());
  dense_.resize(dense_before_.back());
  for_each_node([&](std::uint32_t node) {
    std::uint32_t* to = dense_.data() + dense_before_[node];
    for_each(node, [&](std::uint32_t i) { *to++ = i; });
  });
}

HybridSearch::Work HybridSearch::met() const {
  Work work;
  for (const BlockQueues& queues : block_queues_) {
    work.rows += queues.rows_done();
    work.near += queues.pairs_done();
  }
  for (const SpaceQueue& queue : entry_queues_) work.entries += queue.done;
  for (const GridQueues& queues : grid_queues_) work.tests += queues.tests_done;
  return work;
}

HybridSearch::Work HybridSearch::work() const {
  Work work = met();
  work.rows -= before_.rows, work.near -= before_.near;
  work.entries -= before_.entries, work.tests -= before_.tests;
  work.crowded = std::uint64_t{crowding_.crowded_nodes()} * BlockTree::group * BlockTree::block;
  work.dense = dense_count_;
  return work;
}

}  // namespace catena

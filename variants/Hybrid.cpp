#include <fmt/format.h>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// Hybrid: the tree of ChainTree, but for nodes that meet more than `crowd` others: where the chain's order
/// says so little of what is near, the spheres of these nodes are searched among each other by Grid's cells.
/// Every other pair is the tree's, whose work is so bounded by `crowd` times the number of nodes. Where a
/// node has just so many others, one costs about as much as the other, so that no small change of a chain
/// makes a great one of the time.
template <class Arithmetic>
class Hybrid final : public HostSearch {
 public:
  explicit Hybrid(const Parameters& parameters)
      : limit_(static_cast<std::uint32_t>(parameters.unsigned_integer("crowd", 0, 1u << 20))),
        team_(parameters),
        block_queues_(team_.size()),
        grid_queues_(team_.size()) {}

  Plan plan() const override {
    return {{"grid of spheres", crowd_.empty(),
             fmt::format("{} of {} nodes of 128 spheres meet more than {} others", crowding_.crowded_nodes(),
                         crowding_.nodes(), limit_)}};
  }

 private:
  void construct(const ChainView& chain) override {
    build_block_tree(chain, tree_, team_);
    find_crowds(tree_, limit_, crowding_, team_);
    gather_crowd();
    const bool everyone = crowd_.size() == chain.size;  // so that their list need not be read
    if (!crowd_.empty())
      build_grid(chain, grid_, everyone ? std::span<const std::uint32_t>() : crowd_, team_);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_uncrowded(chain, tree_, crowding_, block_queues_, collector, team_);
    if (!crowd_.empty()) search_grid(chain, grid_, grid_queues_, collector, team_);
  }
  unsigned lanes() const override { return team_.size(); }

  /// The spheres of all crowded nodes.
  void gather_crowd() {
    crowd_.clear();
    for (std::uint32_t node = 0; node < crowding_.nodes(); ++node) {
      if (!crowding_.crowded(node)) continue;
      const std::uint32_t begin = node * BlockTree::group;
      for (std::uint32_t b = begin; b < begin + tree_.blocks_of(node); ++b)
        for (std::uint32_t k = 0; k < BlockTree::block; ++k)
          if (const std::uint32_t i = tree_.index(b, k); i != BlockTree::no_sphere) crowd_.push_back(i);
    }
  }

  const std::uint32_t limit_;
  const Team team_;
  BlockTree tree_;
  std::vector<BlockQueues> block_queues_;  // [member of the team]
  Crowding crowding_;
  std::vector<std::uint32_t> crowd_;
  SphereGrid grid_;
  std::vector<GridQueues> grid_queues_;
};

const RegisterVariant<Hybrid, Robust> registered{
    {.name = "Hybrid",
     .summary = "ChainTree, and Grid among the spheres whose nodes of 128 meet too many others",
     .parameters = {{"crowd", "32", "a node of 128 spheres that meets more others is left to the grid"},
                    Team::threads_parameter()},
     .cost = Cost{.fixed_us = 0.8, .sphere_ns = 6}}};

}  // namespace
}  // namespace catena

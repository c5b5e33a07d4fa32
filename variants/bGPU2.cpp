#include "catena/core/policies/bGPU2.h"

#include "catena/core/executor/host_executor.h"
#include "catena/core/policies/block_capacity.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// bGPU2 with its one block emulated by the host executor.
template <class Arithmetic>
class bGPU2OnHost final : public Construction<HierarchyView<typename Arithmetic::Bound>> {
  using Bound = typename Arithmetic::Bound;

 public:
  explicit bGPU2OnHost(const Parameters& parameters)
      : executor_(parameters),
        block_(static_cast<std::uint32_t>(parameters.unsigned_integer("block", 1, 1024))) {}

  void build(const ChainView& chain) override {
    policy::require_block_capacity("bGPU2@host", "aGPU2@host", chain.size, block_);
    tree_ = storage_.reset(chain.size);
    if (chain.size == 0) return;
    tree_.root = tree_.size() - 1;
    tree_.height = 1 + halvings(chain.size);
    executor_.for_each_block(1, block_, [&, tree = tree_](HostGroup& group, std::uint32_t) {
      policy::copy_leaves<Arithmetic>(group, tree, chain.spheres);
      group.barrier();
      policy::bGPU2<Arithmetic>::build(group, tree, Level::leaves(tree.leaves), tree.leaves, tree.root);
    });
  }

  HierarchyView<Bound> hierarchy() const override { return tree_; }

 private:
  HostExecutor executor_;
  std::uint32_t block_;
  Hierarchy<Bound> storage_;
  HierarchyView<Bound> tree_{};
};

const RegisterConstruction<bGPU2OnHost, Robust, Literal, Double> registered{
    {.name = "bGPU2@host",
     .summary = "the tree of aCPU2 by one block, a thread per pair, a barrier per level",
     .parameters = {HostExecutor::threads_parameter(),
                    {"block", "768", "threads of the block; it takes twice as many spheres"}},
     .promises = {.same_bits = true}}};

}  // namespace
}  // namespace catena

#include "catena/core/policies/aGPU2.h"

#include "catena/core/executor/host_executor.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// aGPU2 with its blocks emulated by the host executor.
template <class Arithmetic>
class aGPU2OnHost final : public Construction<HierarchyView<typename Arithmetic::Bound>> {
  using Bound = typename Arithmetic::Bound;

 public:
  explicit aGPU2OnHost(const Parameters& parameters)
      : executor_(parameters),
        subtree_(static_cast<std::uint32_t>(parameters.unsigned_integer("subtree", 2, 2048))),
        block_(static_cast<std::uint32_t>(parameters.unsigned_integer("block", 1, 1024))) {}

  void build(const ChainView& chain) override {
    tree_ = storage_.reset(chain.size);
    if (chain.size == 0) return;
    executor_.for_each_block(
        (chain.size - 1) / subtree_ + 1, subtree_ / 2, [&](HostGroup& group, std::uint32_t block) {
          policy::copy_leaves<Arithmetic>(group, tree_, chain.spheres, block * subtree_, subtree_);
        });
    const auto run_stage = [&](const policy::SubtreeStage& stage) {
      executor_.for_each_block(stage.subtrees(), subtree_ / 2, [&](HostGroup& group, std::uint32_t s) {
        policy::aGPU2<Arithmetic>::build_subtree(group, tree_, stage, s);
      });
    };
    const auto run_top = [&](const Level& roots, std::uint32_t next, std::uint32_t root_slot) {
      executor_.for_each_block(1, block_, [&](HostGroup& group, std::uint32_t) {
        policy::bGPU2<Arithmetic>::build(group, tree_, roots, next, root_slot);
      });
    };
    policy::aGPU2<Arithmetic>::build(tree_, subtree_, 2 * block_, run_stage, run_top);
  }

  HierarchyView<Bound> hierarchy() const override { return tree_; }

 private:
  HostExecutor executor_;
  std::uint32_t subtree_, block_;
  Hierarchy<Bound> storage_;
  HierarchyView<Bound> tree_{};
};

const RegisterConstruction<aGPU2OnHost, Robust, Literal, Double> registered{
    {.name = "aGPU2@host",
     .summary = "subtrees by independent blocks, then the top over their roots, any n",
     .parameters = {HostExecutor::threads_parameter(),
                    {"subtree", "384", "leaves of a subtree; its block has half as many threads"},
                    {"block", "768",
                     "threads of the block that builds the top; it takes twice as many roots"}},
     .promises = {.same_bits = true}}};

}  // namespace
}  // namespace catena

#include <algorithm>

#include "catena/core/policies/aGPU2.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_construction.h"
#include "catena/cuda/device_group.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {
namespace {

/// First stage: each block copies its own leaves, then builds its subtree.
template <class Arithmetic>
__global__ void build_leaf_subtrees(const __grid_constant__ ChainView chain,
                                    HierarchyView<typename Arithmetic::Bound> tree,
                                    policy::SubtreeStage stage) {
  DeviceGroup group;
  const Level own = stage.nodes(blockIdx.x);
  policy::copy_leaves<Arithmetic>(group, tree, chain.spheres, own.first, own.size);
  group.barrier();
  policy::aGPU2<Arithmetic>::build_subtree(group, tree, stage, blockIdx.x);
}

/// Later stages, over the roots of the stage before.
template <class Arithmetic>
__global__ void build_subtrees(HierarchyView<typename Arithmetic::Bound> tree, policy::SubtreeStage stage) {
  DeviceGroup group;
  policy::aGPU2<Arithmetic>::build_subtree(group, tree, stage, blockIdx.x);
}

template <class Arithmetic>
__global__ void build_top(HierarchyView<typename Arithmetic::Bound> tree, Level roots, std::uint32_t next,
                          std::uint32_t root_slot) {
  DeviceGroup group;
  policy::bGPU2<Arithmetic>::build(group, tree, roots, next, root_slot);
}

/// aGPU2 (Section 4.3) on the device.
template <class Arithmetic>
class aGPU2 final : public DeviceConstruction<typename Arithmetic::Bound> {
  using Tree = HierarchyView<typename Arithmetic::Bound>;

 public:
  explicit aGPU2(const Parameters& parameters)
      : subtree_(static_cast<std::uint32_t>(parameters.unsigned_integer("subtree", 2, 2048))),
        block_(static_cast<std::uint32_t>(parameters.unsigned_integer("block", 1, 1024))) {}

  void enqueue(const ChainView& chain, StreamHandle handle) override {
    this->enqueue_tree(chain.size, handle, [&](Tree& tree, cudaStream_t stream) {
      bool first = true;
      const auto run_stage = [&](const policy::SubtreeStage& stage) {
        if (first)
          launch_blocks(build_leaf_subtrees<Arithmetic>, stage.subtrees(), subtree_ / 2, stream, chain, tree,
                        stage);
        else
          launch_blocks(build_subtrees<Arithmetic>, stage.subtrees(), subtree_ / 2, stream, tree, stage);
        first = false;
      };
      const auto run_top = [&](const Level& roots, std::uint32_t next, std::uint32_t root_slot) {
        const std::uint32_t threads = std::min(block_, (roots.pairs() + 31) / 32 * 32);
        launch_blocks(build_top<Arithmetic>, 1, threads, stream, tree, roots, next, root_slot);
      };
      policy::aGPU2<Arithmetic>::build(tree, subtree_, 2 * block_, run_stage, run_top);
    });
  }

 private:
  std::uint32_t subtree_, block_;
};

const RegisterConstruction<aGPU2, Robust, Literal, Double> registered{
    {.name = "aGPU2",
     .summary = "subtrees by independent blocks, then the top over their roots, any n",
     .place = Place::device(),
     .parameters = with_device(
         {{"subtree", "384", "leaves of a subtree; its block has half as many threads"},
          {"block", "768", "most threads of the block that builds the top; it takes twice as many roots"}}),
     .promises = {.same_bits = true},
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

#include "catena/core/policies/bGPU2.h"
#include "catena/core/policies/block_capacity.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_construction.h"
#include "catena/cuda/device_group.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {
namespace {

template <class Arithmetic>
__global__ void build_tree(const __grid_constant__ ChainView chain,
                           HierarchyView<typename Arithmetic::Bound> tree) {
  DeviceGroup group;
  policy::copy_leaves<Arithmetic>(group, tree, chain.spheres);
  group.barrier();
  policy::bGPU2<Arithmetic>::build(group, tree, Level::leaves(tree.leaves), tree.leaves, tree.root);
}

/// bGPU2 (Section 4.2) on the device: one block, a thread per pair, a barrier per level.
template <class Arithmetic>
class bGPU2 final : public DeviceConstruction<typename Arithmetic::Bound> {
  using Tree = HierarchyView<typename Arithmetic::Bound>;

 public:
  explicit bGPU2(const Parameters& parameters) : block_(parameters.unsigned_integer("block", 0, 1024)) {
    if (block_ == 0) block_ = max_block_threads();
  }

  void build(const ChainView& chain) override {
    policy::require_block_capacity("bGPU2", "aGPU2", chain.size, block_);
    this->build_on_device(chain.size, [&](Tree& tree, cudaStream_t stream) {
      tree.root = tree.size() - 1;
      tree.height = 1 + halvings(chain.size);
      launch_blocks(build_tree<Arithmetic>, 1, block_, stream, chain, tree);
    });
  }

 private:
  unsigned block_;
};

const RegisterConstruction<bGPU2, Robust, Literal, Double> registered{
    {.name = "bGPU2",
     .summary = "the tree of aCPU2 by one block, a thread per pair, a barrier per level",
     .space = Space::device,
     .parameters = {{"block", "0",
                     "threads of the block, which takes twice as many spheres; 0: the device's limit"}},
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

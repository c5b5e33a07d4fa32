#include "catena/core/policies/bGPU2.h"
#include "catena/core/policies/block_capacity.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_group.cuh"
#include "catena/cuda/device_tree.h"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/stream.h"

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
class bGPU2 final : public Construction<typename Arithmetic::Bound> {
  using Bound = typename Arithmetic::Bound;

 public:
  explicit bGPU2(const Parameters& parameters) : block_(parameters.unsigned_integer("block", 0, 1024)) {
    if (block_ == 0) block_ = max_block_threads();
  }

  void build(const ChainView& chain) override {
    policy::require_block_capacity("bGPU2", "aGPU2", chain.size, block_);
    tree_ = storage_.reset(chain.size, stream_);
    if (chain.size == 0) return;
    tree_.root = tree_.size() - 1;
    tree_.height = 1 + halvings(chain.size);
    timer_.start(stream_);
    launch_blocks(build_tree<Arithmetic>, 1, block_, stream_, chain, tree_);
    timer_.stop(stream_);
    build_ms_ = timer_.ms();
  }

  HierarchyView<Bound> hierarchy() const override { return tree_; }
  double own_ms() const override { return build_ms_; }

 private:
  unsigned block_;
  Stream stream_;
  EventTimer timer_;
  DeviceTree<Bound> storage_;
  HierarchyView<Bound> tree_{};
  double build_ms_ = 0;
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

#include <string>

#include "catena/core/error.h"
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
  explicit bGPU2(const Parameters& parameters)
      : block_(static_cast<unsigned>(parameters.unsigned_integer("block", 0, 1024))) {
    const DeviceScope scope(device_of(parameters));
    const unsigned most = most_block_threads(reinterpret_cast<const void*>(build_tree<Arithmetic>));
    if (block_ > most)
      throw CapacityError("bGPU2(block=" + std::to_string(block_) + "): blocks of this kernel have at most " +
                          std::to_string(most) + " threads here");
    if (block_ == 0) block_ = most;
  }

  void enqueue(const ChainView& chain, StreamHandle handle) override {
    policy::require_block_capacity("bGPU2", "aGPU2", chain.size, block_);
    this->enqueue_tree(chain.size, handle, [&](Tree& tree, cudaStream_t stream) {
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
     .place = Place::device(),
     .parameters = with_device(
         {{"block", "0", "threads of the block, which takes twice as many spheres; 0: the kernel's limit"}}),
     .promises = {.same_bits = true},
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

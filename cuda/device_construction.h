#pragma once
#include "catena/core/strategy/stages.h"
#include "catena/cuda/device_tree.h"

namespace catena::cuda {

/// What every construction of the paper's tree on the device has: the tree there.
template <class Bound>
class DeviceConstruction : public Construction<HierarchyView<Bound>> {
 public:
  HierarchyView<Bound> hierarchy() const override { return tree_; }

 protected:
  /// Makes room for n leaves, then runs `launch`, which fills the tree; nothing for n = 0.
  template <class Launch>
  void enqueue_tree(std::uint32_t n, StreamHandle handle, const Launch& launch) {
    const auto stream = static_cast<cudaStream_t>(handle);
    tree_ = storage_.reset(n, stream);
    if (n > 0) launch(tree_, stream);
  }

 private:
  DeviceTree<Bound> storage_;
  HierarchyView<Bound> tree_{};
};

}  // namespace catena::cuda

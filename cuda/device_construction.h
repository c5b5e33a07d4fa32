#pragma once
#include "catena/core/strategy/stages.h"
#include "catena/cuda/device_tree.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {

/// What every construction on the device has: a stream, the tree there, and the time of its kernels.
template <class Bound>
class DeviceConstruction : public Construction<Bound> {
 public:
  HierarchyView<Bound> hierarchy() const override { return tree_; }
  double own_ms() const override { return build_ms_; }

 protected:
  /// Makes room for n leaves, then runs `launch`, which fills the tree, between two events; nothing for n =
  /// 0.
  template <class Launch>
  void build_on_device(std::uint32_t n, const Launch& launch) {
    tree_ = storage_.reset(n, stream_);
    if (n == 0) return;
    timer_.start(stream_);
    launch(tree_, stream_);
    timer_.stop(stream_);
    build_ms_ = timer_.ms();
  }

 private:
  Stream stream_;
  EventTimer timer_;
  DeviceTree<Bound> storage_;
  HierarchyView<Bound> tree_{};
  double build_ms_ = 0;
};

}  // namespace catena::cuda

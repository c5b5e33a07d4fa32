#pragma once
#include "catena/core/arithmetic/in_range.h"
#include "catena/core/strategy/stages.h"
#include "catena/cuda/device_result.h"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {

/// A traversal on the device: Search<Arithmetic>::kernel, run by Search<Arithmetic>::threads_per_sphere
/// threads for each sphere of the chain.
template <class Arithmetic, template <class> class Search>
class DeviceTraversal final : public Traversal<typename Arithmetic::Bound> {
 public:
  explicit DeviceTraversal(const Parameters& parameters)
      : threads_(parameters.unsigned_integer("threads", 32, 1024)) {}

  void find(const ChainView& chain, const HierarchyView<typename Arithmetic::Bound>& tree,
            const Request& request, Collisions& result) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      using Chosen = Search<decltype(tests)>;
      result_.run(chain.size, request, result, stream_, [&](const ResultView& view) {
        launch(Chosen::kernel, std::uint64_t{Chosen::threads_per_sphere} * chain.size, threads_, stream_,
               chain, tree, view);
      });
    });
  }

  double own_ms() const override { return result_.find_ms(); }
  double own_transfer_ms() const override { return result_.transfer_ms(); }

 private:
  unsigned threads_;
  Stream stream_;
  DeviceResult result_;
};

}  // namespace catena::cuda

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/policies/GPU2.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_result.h"
#include "catena/cuda/device_visitor.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {
namespace {

template <class Tests>
__global__ void search(const __grid_constant__ ChainView chain,
                       const __grid_constant__ HierarchyView<typename Tests::Bound> tree,
                       const __grid_constant__ ResultView result) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= chain.size) return;
  DeviceVisitor visitor(i, result);
  if (visitor.satisfied()) return;
  policy::GPU2<Tests>::visit(i, chain, tree, visitor);
  if (result.count != nullptr) result.count[i] = visitor.collisions;
  visitor.finish();
}

/// GPU2 (Section 5.2) on the device: one thread per sphere against the tree, explicit stack.
template <class Arithmetic>
class GPU2 final : public Traversal<typename Arithmetic::Bound> {
 public:
  explicit GPU2(const Parameters& parameters) : threads_(parameters.unsigned_integer("threads", 32, 1024)) {}

  void find(const ChainView& chain, const HierarchyView<typename Arithmetic::Bound>& tree,
            const Request& request, Collisions& result) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      result_.run(chain.size, request, result, stream_, [&](const ResultView& view) {
        launch(search<decltype(tests)>, chain.size, threads_, stream_, chain, tree, view);
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

const RegisterTraversal<GPU2, Robust, Literal, Double> registered{
    {.name = "GPU2",
     .summary = "one thread per sphere against the tree, explicit stack",
     .space = Space::device,
     .parameters = {{"threads", "128", "threads of a block"}},
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

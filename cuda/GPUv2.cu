#include "catena/core/arithmetic/in_range.h"
#include "catena/core/policies/GPUv2.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_result.h"
#include "catena/cuda/device_visitor.cuh"
#include "catena/cuda/launch.cuh"

namespace catena::cuda {
namespace {

/// Threads 0..n-1 are the spheres' first threads, n..2n-1 their second ones, so that the threads of a warp
/// walk the same subtree.
template <class Tests>
__global__ void search(const __grid_constant__ ChainView chain,
                       const __grid_constant__ HierarchyView<typename Tests::Bound> tree,
                       const __grid_constant__ ResultView result) {
  const std::uint64_t t = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (t >= std::uint64_t{2} * chain.size) return;
  const std::uint32_t half = t >= chain.size, i = static_cast<std::uint32_t>(t - (half ? chain.size : 0));
  DeviceVisitor visitor(i, result);
  if (visitor.satisfied()) return;
  policy::GPUv2<Tests>::visit(i, half, chain, tree, visitor);
  if (result.count != nullptr && visitor.collisions > 0) atomicAdd(result.count + i, visitor.collisions);
  visitor.finish();
}

/// GPUv2 (Section 5.2) on the device: two threads per sphere, one per child of the root.
template <class Arithmetic>
class GPUv2 final : public Traversal<typename Arithmetic::Bound> {
 public:
  explicit GPUv2(const Parameters& parameters) : threads_(parameters.unsigned_integer("threads", 32, 1024)) {}

  void find(const ChainView& chain, const HierarchyView<typename Arithmetic::Bound>& tree,
            const Request& request, Collisions& result) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      result_.run(chain.size, request, result, stream_, [&](const ResultView& view) {
        launch(search<decltype(tests)>, std::uint64_t{2} * chain.size, threads_, stream_, chain, tree, view);
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

const RegisterTraversal<GPUv2, Robust, Literal, Double> registered{
    {.name = "GPUv2",
     .summary = "two threads per sphere, one per child of the root",
     .space = Space::device,
     .parameters = {{"threads", "128", "threads of a block"}},
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

#include "catena/core/policies/GPU2.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_traversal.cuh"
#include "catena/cuda/device_visitor.cuh"

namespace catena::cuda {
namespace {

template <class Tests>
__global__ void search(const __grid_constant__ ChainView chain,
                       const __grid_constant__ HierarchyView<typename Tests::Bound> tree,
                       const __grid_constant__ ResidentAnswer answer, SphereRange queries) {
  const std::uint32_t i = queries.begin + blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= queries.end) return;
  DeviceVisitor visitor(i, answer);
  if (visitor.satisfied()) return;
  policy::GPU2<Tests>::visit(i, chain, tree, visitor);
  if (answer.count != nullptr) answer.count[i] = visitor.collisions;
  visitor.finish();
}

template <class Arithmetic>
struct OneThreadASphere {
  static constexpr auto kernel = search<Arithmetic>;
  static constexpr unsigned threads_per_sphere = 1;
};

/// GPU2 (Section 5.2) on the device: one thread per sphere against the tree, explicit stack.
template <class Arithmetic>
using GPU2 = DeviceTraversal<Arithmetic, OneThreadASphere>;

const RegisterTraversal<GPU2, Robust, Literal, Double> registered{
    {.name = "GPU2",
     .summary = "one thread per sphere against the tree, explicit stack",
     .place = Place::device(),
     .parameters = with_device({{"threads", "128", "threads of a block"}}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

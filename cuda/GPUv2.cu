#include "catena/core/policies/GPUv2.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_traversal.cuh"
#include "catena/cuda/device_visitor.cuh"

namespace catena::cuda {
namespace {

/// Of n spheres that are asked about, threads 0..n-1 are the first threads, n..2n-1 the second ones, so that
/// the threads of a warp walk the same subtree.
template <class Tests>
__global__ void search(const __grid_constant__ ChainView chain,
                       const __grid_constant__ HierarchyView<typename Tests::Bound> tree,
                       const __grid_constant__ ResidentAnswer answer, SphereRange queries) {
  const std::uint64_t t = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x;
  const std::uint32_t n = queries.size();
  if (t >= std::uint64_t{2} * n) return;
  const std::uint32_t half = t >= n, i = queries.begin + static_cast<std::uint32_t>(t - (half ? n : 0));
  DeviceVisitor visitor(i, answer);
  if (visitor.satisfied()) return;
  policy::GPUv2<Tests>::visit(i, half, chain, tree, visitor);
  if (answer.count != nullptr && visitor.collisions > 0) atomicAdd(answer.count + i, visitor.collisions);
  visitor.finish();
}

template <class Arithmetic>
struct TwoThreadsASphere {
  static constexpr auto kernel = search<Arithmetic>;
  static constexpr unsigned threads_per_sphere = policy::GPUv2<Arithmetic>::threads_per_sphere;
};

/// GPUv2 (Section 5.2) on the device: two threads per sphere, one per child of the root.
template <class Arithmetic>
using GPUv2 = DeviceTraversal<Arithmetic, TwoThreadsASphere>;

const RegisterTraversal<GPUv2, Robust, Literal, Double> registered{
    {.name = "GPUv2",
     .summary = "two threads per sphere, one per child of the root",
     .place = Place::device(),
     .parameters = with_device({{"threads", "128", "threads of a block"}}),
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda

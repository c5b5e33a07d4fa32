#include "catena/core/policies/GPUv2.h"

#include "catena/core/executor/host_traversal.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// The two threads of a sphere, one after the other.
template <class Arithmetic>
struct BothThreads {
  template <class V>
  static void visit(std::uint32_t i, const ChainView& chain,
                    const HierarchyView<typename Arithmetic::Bound>& tree, V& visitor) {
    for (std::uint32_t thread = 0; thread < policy::GPUv2<Arithmetic>::threads_per_sphere; ++thread)
      policy::GPUv2<Arithmetic>::visit(i, thread, chain, tree, visitor);
  }
};

/// GPUv2 with its per-sphere visits run by the host executor.
template <class Arithmetic>
using GPUv2OnHost = HostTraversal<Arithmetic, BothThreads>;

const RegisterTraversal<GPUv2OnHost, Robust, Literal, Double> registered{
    {.name = "GPUv2@host",
     .summary = "two visits per sphere, one per child of the root",
     .parameters = {HostExecutor::threads_parameter()},
     .promises = {.same_order = true}}};

}  // namespace
}  // namespace catena

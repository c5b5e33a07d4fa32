#include "catena/core/policies/GPUv2.h"

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/host_executor.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// GPUv2 with the two threads of a sphere run one after the other by the host executor.
template <class Arithmetic>
class GPUv2OnHost final : public Traversal<typename Arithmetic::Bound> {
  using Bound = typename Arithmetic::Bound;

 public:
  explicit GPUv2OnHost(const Parameters& parameters) : executor_(parameters) {}

  void find(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
            Collisions& result) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      executor_.for_each_sphere(chain.size, request, result, visit<decltype(tests)>(chain, tree));
    });
  }

  Accounting evidence() const override { return Accounting::from_both_ends; }

  void find_with_evidence(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
                          Collisions& result, EvidenceSink& sink) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      executor_.for_each_sphere(chain.size, request, result, sink, visit<decltype(tests)>(chain, tree));
    });
  }

 private:
  template <class Tests>
  static auto visit(const ChainView& chain, const HierarchyView<Bound>& tree) {
    return [&](std::uint32_t i, auto& visitor) {
      for (std::uint32_t thread = 0; thread < policy::GPUv2<Tests>::threads_per_sphere; ++thread)
        policy::GPUv2<Tests>::visit(i, thread, chain, tree, visitor);
    };
  }

  HostExecutor executor_;
};

const RegisterTraversal<GPUv2OnHost, Robust, Literal, Double> registered{
    {.name = "GPUv2@host",
     .summary = "two visits per sphere, one per child of the root",
     .parameters = {HostExecutor::threads_parameter()}}};

}  // namespace
}  // namespace catena

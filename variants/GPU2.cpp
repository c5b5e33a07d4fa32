#include "catena/core/policies/GPU2.h"

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/host_executor.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// GPU2 with its per-sphere visits run by the host executor.
template <class Arithmetic>
class GPU2OnHost final : public Traversal<typename Arithmetic::Bound> {
  using Bound = typename Arithmetic::Bound;

 public:
  explicit GPU2OnHost(const Parameters& parameters) : executor_(parameters) {}

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
    return [&](std::uint32_t i, auto& visitor) { policy::GPU2<Tests>::visit(i, chain, tree, visitor); };
  }

  HostExecutor executor_;
};

const RegisterTraversal<GPU2OnHost, Robust, Literal, Double> registered{
    {.name = "GPU2@host",
     .summary = "each sphere against the tree, explicit stack",
     .parameters = {HostExecutor::threads_parameter()}}};

}  // namespace
}  // namespace catena

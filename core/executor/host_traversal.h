#pragma once
#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/host_executor.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/stages.h"

namespace catena {

/// A device traversal run by the host executor. Search<Arithmetic>::visit(i, chain, tree, visitor) is all
/// that the threads of sphere i do.
template <class Arithmetic, template <class> class Search>
class HostTraversal final : public Traversal<HierarchyView<typename Arithmetic::Bound>> {
  using Bound = typename Arithmetic::Bound;

 public:
  explicit HostTraversal(const Parameters& parameters) : executor_(parameters) {}

  void find(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
            Collisions& result) override {
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      executor_.for_each_sphere(chain.size, request, result, visit<decltype(tests)>(chain, tree));
    });
    in_range_ = in_range<Arithmetic>(chain);
    queries_ = request.queries.within(chain.size).size();
  }

  Plan plan() const override {
    Plan plan = range_checks_plan<Arithmetic>(in_range_);
    plan.push_back(executor_.decision(queries_));
    return plan;
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
      const HierarchyView<Bound> own = tree;  // stays in registers, as nothing else can point to it
      Search<Tests>::visit(i, chain, own, visitor);
    };
  }

  HostExecutor executor_;
  bool in_range_ = false;  ///< of the last search
  std::uint32_t queries_ = 0;
};

}  // namespace catena

#include "catena/core/policies/GPU1.h"

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/host_executor.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// GPU1 with its per-sphere visits run by the host executor.
template <class Arithmetic>
class GPU1OnHost final : public Variant {
 public:
  explicit GPU1OnHost(const Parameters& parameters) : executor_(parameters) {}

  void build(const Chain&) override {}

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    const Stopwatch watch;
    const ChainView view = chain.view();
    with_tests_for<Arithmetic>(view, [&](auto tests) {
      executor_.for_each_sphere(view.size, request, result, visit<decltype(tests)>(view));
    });
    timings_.find_ms = watch.ms();
    in_range_ = in_range<Arithmetic>(view);
    queries_ = request.queries.within(view.size).size();
  }

  Accounting evidence() const override { return Accounting::from_both_ends; }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    const Stopwatch watch;
    const ChainView view = chain.view();
    with_tests_for<Arithmetic>(view, [&](auto tests) {
      executor_.for_each_sphere(view.size, request, result, sink, visit<decltype(tests)>(view));
    });
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }
  Plan plan() const override {
    Plan plan = range_checks_plan<Arithmetic>(in_range_);
    plan.push_back(executor_.decision(queries_));
    return plan;
  }

 private:
  template <class Tests>
  static auto visit(const ChainView& view) {
    return [&view](std::uint32_t i, auto& visitor) { policy::GPU1<Tests>::visit(i, view, visitor); };
  }

  HostExecutor executor_;
  Timings timings_;
  bool in_range_ = false;  ///< of the last search
  std::uint32_t queries_ = 0;
};

const RegisterVariant<GPU1OnHost, Robust, Literal, Double> registered{
    {.name = "GPU1@host",
     .summary = "all pairs, one visit per sphere",
     .parameters = {HostExecutor::threads_parameter()},
     .all_pairs = true,
     .promises = {.same_order = true}}};

}  // namespace
}  // namespace catena

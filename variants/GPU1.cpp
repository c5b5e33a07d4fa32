#include "catena/core/policies/GPU1.h"

#include "catena/core/executor/host_executor.h"
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
    executor_.for_each_sphere(view.size, request, result, visit(view));
    timings_.find_ms = watch.ms();
  }

  Accounting evidence() const override { return Accounting::from_both_ends; }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    const Stopwatch watch;
    const ChainView view = chain.view();
    executor_.for_each_sphere(view.size, request, result, sink, visit(view));
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }

 private:
  static auto visit(const ChainView& view) {
    return [&view](std::uint32_t i, auto& visitor) { policy::GPU1<Arithmetic>::visit(i, view, visitor); };
  }

  HostExecutor executor_;
  Timings timings_;
};

const RegisterVariant<GPU1OnHost, Robust, Literal, Double> registered{
    {.name = "GPU1@host",
     .summary = "all pairs, one visit per sphere",
     .parameters = {HostExecutor::threads_parameter()},
     .all_pairs = true}};

}  // namespace
}  // namespace catena

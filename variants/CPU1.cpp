#include <algorithm>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/strand_table.h"

namespace catena {
namespace {

/// CPU1 (Section 3): every sphere against every later one, sequentially. O(n^2), no hierarchy.
template <class Arithmetic>
class CPU1 final : public Variant {
 public:
  explicit CPU1(const Parameters& parameters) : strands_(parameters), range_(parameters) {}

  void build(const Chain&) override {}

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    search(strands_.seen(chain.view()), request, result, [](std::uint32_t, std::uint32_t) {});
  }

  Accounting evidence() const override { return Accounting::each_pair; }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    const ChainView view = strands_.seen(chain.view());
    search(view, request, result, [&](std::uint32_t i, std::uint32_t j) {
      view.neighbours(i, j) ? sink.excluded(i, j) : sink.tested(i, j);
    });
  }

  Timings timings() const override { return timings_; }

  Plan plan() const override {
    Plan plan = range_.plan();
    plan.push_back(strands_.told());
    return plan;
  }

 private:
  /// `met(i, j)` is called for every pair that is compared.
  template <class Met>
  void search(const ChainView& view, const Request& request, Collisions& result, const Met& met) {
    const Stopwatch watch;
    PairCollector collector(view.size, request, result);
    range_.with_tests_for<Arithmetic>(
        view, [&](auto tests) { compare_all<decltype(tests)>(view, collector, met); });
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  template <class Tests, class Met>
  static void compare_all(const ChainView& view, PairCollector& collector, const Met& met) {
    PairCollector::Lane& lane = collector.lane(0);
    const SphereRange queries = collector.queries();
    const Sphere* const spheres = view.spheres;
    for (std::uint32_t i = 0; i < queries.end && !lane.satisfied(); ++i) {
      const auto sphere = Tests::bound(spheres[i]);
      // A sphere before the range is compared with those in it alone, whose counts need it.
      const std::uint32_t first = std::max(i + 1, i < queries.begin ? queries.begin : 0u);
      const std::uint32_t end = i < queries.begin ? queries.end : view.size;
      for (std::uint32_t j = first; j < end; ++j) {
        met(i, j);
        if (!Tests::overlap(sphere, Tests::bound(spheres[j]))) [[likely]]
          continue;
        if (!view.neighbours(i, j)) lane.collide(i, j);
      }
    }
  }

  StrandTable strands_;
  RangeChecks range_;
  Timings timings_;
};

const RegisterVariant<CPU1, Robust, Literal, Double> registered{
    {.name = "CPU1",
     .summary = "all pairs, sequential, O(n^2)",
     .parameters = {strands_parameter(), range_parameter()},
     .all_pairs = true,
     .cost = Cost{.fixed_us = 0.05, .sphere_pair_ns = 1.3}}};

}  // namespace
}  // namespace catena

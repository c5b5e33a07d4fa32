#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// CPU1 (Section 3): every sphere against every later one, sequentially. O(n^2), no hierarchy.
template <class Arithmetic>
class CPU1 final : public Variant {
 public:
  void build(const Chain&) override {}

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    search(chain.view(), request, result, [](std::uint32_t, std::uint32_t) {});
  }

  Accounting evidence() const override { return Accounting::each_pair; }

  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    const ChainView view = chain.view();
    search(view, request, result, [&](std::uint32_t i, std::uint32_t j) {
      view.neighbours(i, j) ? sink.excluded(i, j) : sink.tested(i, j);
    });
  }

  Timings timings() const override { return timings_; }

 private:
  /// `met(i, j)` is called for every pair that is compared.
  template <class Met>
  void search(const ChainView& view, const Request& request, Collisions& result, const Met& met) {
    const Stopwatch watch;
    PairCollector collector(view.size, request, result);
    PairCollector::Lane& lane = collector.lane(0);
    const bool counts = request.want != Request::Want::any;
    for (std::uint32_t i = 0; i < view.size && !lane.satisfied(); ++i) {
      const auto sphere = Arithmetic::bound(view.spheres[i]);
      for (std::uint32_t j = i + 1; j < view.size; ++j) {
        met(i, j);
        if (!Arithmetic::overlap(sphere, Arithmetic::bound(view.spheres[j])) || view.neighbours(i, j))
          continue;
        if (counts) ++result.count[i], ++result.count[j];
        lane.pair(i, j);
      }
    }
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  Timings timings_;
};

const RegisterVariant<CPU1, Robust, Literal, Double> registered{
    {.name = "CPU1", .summary = "all pairs, sequential, O(n^2)", .all_pairs = true}};

}  // namespace
}  // namespace catena

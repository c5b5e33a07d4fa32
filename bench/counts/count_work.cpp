#include "catena/bench/counts/count_work.h"

#include <algorithm>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

class WorkSink final : public EvidenceSink {
 public:
  explicit WorkSink(std::uint32_t spheres) : n_(spheres) {}

  void discarded(std::uint32_t a, std::uint32_t b) override {
    a < n_&& b < n_ ? ++pair_tests_ : ++discarded_nodes_;
  }
  void tested(std::uint32_t, std::uint32_t) override { ++pair_tests_; }
  void excluded(std::uint32_t, std::uint32_t) override {}
  void compared(std::uint32_t, std::uint32_t) override { ++compared_; }

  /// A search without nodes has none to go on to, whatever trees tell of what it left out.
  Work work(std::uint64_t bytes_of_bound) const {
    const std::uint64_t gone_on = compared_ - std::min(compared_, discarded_nodes_);
    return {pair_tests_, compared_, (pair_tests_ + compared_) * bytes_of_bound + gone_on * sizeof(Links)};
  }

 private:
  const std::uint32_t n_;
  std::uint64_t pair_tests_ = 0, compared_ = 0, discarded_nodes_ = 0;
};

}  // namespace

std::optional<Work> count_work(const VariantInfo& info, const Chain& chain) {
  // Cells say what they left out by trees that no search went through.
  if (!info.has_tree && !info.all_pairs) return {};
  const auto& registry = StrategyRegistry::instance();
  const auto variant = registry.make(info.on_device() ? registry.on_host(info.parts).text() : info.name);
  if (variant->evidence() == Accounting::none) return {};
  variant->build(chain);
  WorkSink sink(chain.size());
  Collisions found;
  variant->find_with_evidence(chain, {.want = Request::Want::counts}, found, sink);
  // All pairs are compared as stored; a tree in binary64 has wide bounds.
  const bool wide = info.arithmetic == Double::name && !info.all_pairs;
  return sink.work(wide ? sizeof(Sphere64) : sizeof(Sphere));
}

}  // namespace catena::bench

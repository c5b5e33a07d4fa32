#include "catena/bench/counts/count_work.h"

#include <algorithm>
#include <string>

#include "catena/core/hierarchy/hierarchy.h"

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

  Work work(std::uint64_t bytes_of_bound) const {
    return {pair_tests_, compared_,
            (pair_tests_ + compared_) * bytes_of_bound + (compared_ - discarded_nodes_) * sizeof(Links)};
  }

 private:
  const std::uint32_t n_;
  std::uint64_t pair_tests_ = 0, compared_ = 0, discarded_nodes_ = 0;
};

/// "aGPU2(subtree=256)+GPU2/literal" with the stages that have a twin on the host replaced by it.
std::string on_host(const std::string& name) {
  const auto known = StrategyRegistry::instance().strategy_names();
  std::string twin;
  for (std::size_t at = 0; at < name.size();) {
    const auto end = std::min(name.find_first_of("+/(", at), name.size());
    const std::string stage = name.substr(at, end - at);
    const bool has_twin = std::ranges::find(known, stage + "@host") != known.end();
    twin += stage + (has_twin ? "@host" : "");
    auto rest =
        end < name.size() && name[end] == '(' ? std::min(name.find(')', end), name.size() - 1) + 1 : end;
    if (rest < name.size()) ++rest;
    twin += name.substr(end, rest - end);
    at = rest;
  }
  return twin;
}

}  // namespace

std::optional<Work> count_work(const VariantInfo& info, const Chain& chain) {
  auto variant = StrategyRegistry::instance().make(info.on_device ? on_host(info.name) : info.name);
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

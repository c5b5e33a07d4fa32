#pragma once
#include <functional>
#include <utility>
#include <vector>

#include "catena/core/cells/told_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/resident_variant.h"
#include "catena/cuda/device.h"

namespace catena::cuda {

/// A variant of a device whose evidence is told on the host, by the same policies, of what the device built.
template <class Arithmetic>
class ToldVariant : public ResidentVariant, public EvidenceNodes {
 public:
  explicit ToldVariant(const Parameters& parameters)
      : ResidentVariant(StrategyRegistry::instance().make_device(device_of(parameters)), Upload(parameters)),
        range_(parameters) {}

  Plan plan() const override { return with_upload_told(range_.plan()); }

  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built() && chain.size() > 0)
      told(chain.view(), [&](const ToldSearch& search) { search.show(visitor); });
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    check(chain);
    PairCollector collector(chain.size(), request, result);
    if (chain.size() > 0)
      told(chain.view(), [&](const ToldSearch& search) { search.search(collector.lane(0), sink); });
    collector.finish();
  }

 protected:
  using Use = std::function<void(const ToldSearch&)>;
  /// Copies what the device built of this chain, which has spheres, to the host, for as long as it is used.
  virtual void told(const ChainView& chain, const Use& use) const = 0;

  RangeChecks range_;
};

/// The parameters of such a variant, which has these of its own.
inline std::vector<ParameterInfo> with_told(std::vector<ParameterInfo> own) {
  own.push_back(range_parameter());
  return with_device(with_upload(std::move(own)));
}

}  // namespace catena::cuda

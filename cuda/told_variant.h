#pragma once
#include <functional>

#include "catena/core/cells/told_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/resident_variant.h"

namespace catena::cuda {

/// A variant of a device whose evidence is told on the host, by the same policies, of what the device built.
template <class Arithmetic>
class ToldVariant : public ResidentVariant, public EvidenceNodes {
 public:
  using ResidentVariant::ResidentVariant;

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

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

  bool in_range_ = false;  ///< of the last search
};

}  // namespace catena::cuda

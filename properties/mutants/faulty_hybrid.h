#pragma once
#include "catena/core/executor/host_search.h"
#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/properties/mutants/mutant.h"

namespace catena::properties {

/// Hybrid with what its build leaves tampered with. It searches, and tells of its search, as the right one
/// does. By default all blocks go by the order of space.
class FaultyHybrid : public HostSearch, public EvidenceNodes {
 public:
  using Base = FaultyHybrid;

  explicit FaultyHybrid(const HybridSearch::Settings& settings = {0, never}) : search_(settings, 1) {}
  Accounting evidence() const override { return Accounting::each_pair; }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built()) search_.show_evidence(chain.view(), visitor);
  }

 protected:
  static constexpr double never = 1e6;  ///< a block costs more than so many times its spheres in cells
  using Parts = HybridSearch::Parts;
  virtual void tamper(const ChainView&, Parts&) {}

 private:
  void construct(const ChainView& chain) override {
    search_.build(chain, team());
    tamper(chain, search_.parts());
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    search_.search(chain, collector, team());
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    search_.search_with_evidence(chain, lane, sink);
  }

  HybridSearch search_;
};

}  // namespace catena::properties

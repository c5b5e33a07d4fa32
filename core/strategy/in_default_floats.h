#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "catena/core/default_floats.h"
#include "catena/core/error.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/keeps_answer.h"
#include "catena/core/strategy/resident.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// A variant as the registry gives it out: whatever the floating-point environment of its caller, it computes
/// in the default one. Functions that only tell are passed on; a test holds that to every function of
/// Variant.
class InDefaultFloats final : public Variant, public KeepsAnswer, public EvidenceNodes {
 public:
  explicit InDefaultFloats(std::unique_ptr<Variant> variant) : variant_(std::move(variant)) {}

  void prepare(const Request& request) override {
    const DefaultFloats floats;
    variant_->prepare(request);
  }
  void build(const Chain& chain) override {
    const DefaultFloats floats;
    variant_->build(chain);
  }
  void update(const Chain& chain, const Moved& moved) override {
    const DefaultFloats floats;
    variant_->update(chain, moved);
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    const DefaultFloats floats;
    variant_->find(chain, request, result);
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    const DefaultFloats floats;
    require_ids(chain);
    variant_->find_with_evidence(chain, request, result, sink);
  }
  Timings timings() const override { return variant_->timings(); }
  Plan plan() const override { return variant_->plan(); }
  std::vector<WorkDone> work() const override { return variant_->work(); }
  std::string answered_by() const override { return variant_->answered_by(); }
  void visit_bounds(BoundsVisitor& visitor) const override {
    const DefaultFloats floats;
    variant_->visit_bounds(visitor);
  }
  Accounting evidence() const override { return variant_->evidence(); }
  ResidentSearch* resident() override {
    resident_.search = variant_->resident();
    return resident_.search == nullptr ? nullptr : &resident_;
  }

  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    const DefaultFloats floats;
    require_ids(chain);
    visit_evidence_nodes(*variant_, chain, visitor);
  }
  const Collisions& find_kept(const Chain& chain, const Request& request) override {
    const DefaultFloats floats;
    // Looked for here, as that takes as long as a short search, and few ask.
    if (const auto keeper = dynamic_cast<KeepsAnswer*>(variant_.get()))
      return keeper->find_kept(chain, request);
    variant_->find(chain, request, own_);
    return own_;
  }

 private:
  static void require_ids(const Chain& chain) {
    if (chain.size() > most_spheres_with_evidence)
      throw CapacityError("evidence is given of chains of up to 2^29 spheres");
  }
  /// What of a resident search is computed on the host: cells and ranges of its chain.
  struct Resident final : ResidentSearch {
    ResidentSearch* search = nullptr;
    void enqueue_build(const ChainView& chain, const Request& request, StreamHandle stream) override {
      const DefaultFloats floats;
      search->enqueue_build(chain, request, stream);
    }
    void enqueue_find(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                      StreamHandle stream) override {
      const DefaultFloats floats;
      search->enqueue_find(chain, request, answer, stream);
    }
    void mend(const ResidentState& seen) override {
      const DefaultFloats floats;
      search->mend(seen);
    }
  };

  std::unique_ptr<Variant> variant_;
  Resident resident_;
  Collisions own_;  ///< of one that keeps no answer
};

}  // namespace catena

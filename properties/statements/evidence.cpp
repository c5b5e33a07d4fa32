#include <fmt/format.h>

#include <new>

#include "catena/core/strategy/evidence_nodes.h"
#include "catena/properties/property.h"
#include "catena/properties/statements/moved_frame.h"
#include "catena/reference/verify.h"

namespace catena::properties {
namespace {

/// A variant that comes to each chain from an earlier frame of it.
class FromAFrame final : public Variant, public EvidenceNodes {
 public:
  FromAFrame(Variant& variant, const Chain& earlier) : variant_(variant), earlier_(earlier) {}

  void prepare(const Request& request) override { variant_.prepare(request); }
  void build(const Chain& chain) override { variant_.build(earlier_), variant_.update(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    variant_.find(chain, request, result);
  }
  Timings timings() const override { return variant_.timings(); }
  void visit_bounds(BoundsVisitor& visitor) const override { variant_.visit_bounds(visitor); }
  Accounting evidence() const override { return variant_.evidence(); }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    variant_.find_with_evidence(chain, request, result, sink);
  }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    visit_evidence_nodes(variant_, chain, visitor);
  }

 private:
  Variant& variant_;
  const Chain& earlier_;
};

/// The evidence of an exact search proves its answer: every pair is accounted for exactly once, what was left
/// out is separate, nodes enclose their spheres; and both searches, with evidence and without, answer what it
/// proves. So it does after an update, of every other chain.
class Evidence final : public Property {
 public:
  std::string name() const override { return "evidence"; }
  bool applies_to(const Subject& subject) const override { return subject.exact(); }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    if (!reference::has_evidence(variant, test.chain)) return std::nullopt;
    if (auto fault = check(variant, test)) return fault;
    if (test.chain.size() % 2 == 0) return std::nullopt;
    const Chain earlier = shaken_frame(test.chain);
    FromAFrame updated(variant, earlier);
    // Not where the earlier frame answered.
    if (!reference::has_evidence(updated, test.chain)) return std::nullopt;
    if (auto fault = check(updated, test)) return "after an update: " + *fault;
    return std::nullopt;
  }

 private:
  static std::optional<std::string> check(Variant& variant, const Case& test) {
    std::uint64_t proved = 0;
    const auto v = reference::verify_by_certificate(variant, test.chain, std::uint64_t{1} << 24, proved);
    if (v.verdict == reference::Verdict::refused) throw CapacityError(v.reason);
    if (v.verdict == reference::Verdict::undecided) throw std::bad_alloc();
    if (v.verdict != reference::Verdict::exact) return v.reason;
    if (proved != test.exact.pair_count)
      return fmt::format("{} pairs proved, {} there are", proved, test.exact.pair_count);
    return std::nullopt;
  }
};

const RegisterProperty<Evidence> registered;

}  // namespace
}  // namespace catena::properties

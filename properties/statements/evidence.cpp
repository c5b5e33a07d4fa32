#include <fmt/format.h>

#include "catena/properties/property.h"
#include "catena/reference/verify.h"

namespace catena::properties {
namespace {

/// The evidence of an exact search proves its answer: every pair is accounted for exactly once, what was left
/// out is separate, nodes enclose their spheres; and both searches, with evidence and without, answer what it
/// proves.
class Evidence final : public Property {
 public:
  std::string name() const override { return "evidence"; }
  bool applies_to(const Subject& subject) const override { return subject.exact(); }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    if (!reference::has_evidence(variant, test.chain)) return std::nullopt;
    std::uint64_t proved = 0;
    const auto v = reference::verify_by_certificate(variant, test.chain, std::uint64_t{1} << 24, proved);
    if (v.verdict == reference::Verdict::refused) throw CapacityError(v.reason);
    if (v.verdict != reference::Verdict::exact) return v.reason;
    if (proved != test.exact.pair_count)
      return fmt::format("{} pairs proved, {} there are", proved, test.exact.pair_count);
    return std::nullopt;
  }
};

const RegisterProperty<Evidence> registered;

}  // namespace
}  // namespace catena::properties

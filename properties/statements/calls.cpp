#include "catena/properties/property.h"
#include "catena/properties/statements/call_script.h"

namespace catena::properties {
namespace {

/// In whatever order a caller prepares, builds, updates and asks, within what it prepared for, each answer is
/// that of the chain of the last build or update: nothing of an earlier chain, request, error or answer is
/// left in it.
class Calls final : public Property {
 public:
  std::string name() const override { return "calls in any order"; }
  bool applies_to(const Subject& subject) const override { return subject.exact(); }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    const auto& shots = shots_(test, [&] { return shots_of(test.chain); });
    const PreparedForAll after(variant);  // also where a declared limit is passed
    return CallScript(variant, shots, seed_of(test.chain), reused_).run();
  }

 private:
  DerivedFrom<std::vector<Shot>> shots_;
  Collisions reused_[2];
};

const RegisterProperty<Calls> registered;

}  // namespace
}  // namespace catena::properties

#include "catena/properties/failing_allocations.h"
#include "catena/properties/property.h"
#include "catena/properties/statements/call_script.h"

namespace catena::properties {
namespace {

/// The same where calls fail: a chain is refused, a sink throws, a chain is asked about that was not built,
/// and, in programs that can have it so, memory is wanting. After a failed build or update the variant says
/// that nothing is built, or answers right where it needs no build, and shows no bounds; after a failed
/// search it answers as if nothing had happened.
class FailingCalls final : public Property {
 public:
  std::string name() const override { return "calls in any order, some of which fail"; }
  bool applies_to(const Subject& subject) const override { return subject.exact(); }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    const auto& shots = shots_(test, [&] { return shots_of(test.chain); });
    const PreparedForAll after(variant);
    // Neither other people's libraries nor those of a device promise anything without memory.
    const bool memory = FailingAllocations::possible() && !subject.info.peer && !subject.info.on_device();
    return CallScript(variant, shots, seed_of(test.chain) + 1, reused_, {.any = true, .memory = memory})
        .run();
  }

 private:
  DerivedFrom<std::vector<Shot>> shots_;
  Collisions reused_[2];
};

const RegisterProperty<FailingCalls> registered;

}  // namespace
}  // namespace catena::properties

#include <fmt/format.h>

#include <map>

#include "catena/properties/allocations.h"
#include "catena/properties/property.h"
#include "catena/properties/statements/moved_frame.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

/// Once a frame was seen, update allocates nothing. With one thread, as starting a thread allocates. Asked
/// only in programs that count allocations.
class NoAllocation final : public Property {
 public:
  std::string name() const override { return "no allocation in update"; }
  bool applies_to(const Subject& subject) const override {
    return Allocations::counter() != nullptr && !subject.info.on_device() && !subject.info.peer;
  }

  std::optional<std::string> check(const Subject& subject, Variant&, const Case& test) override {
    const Chain& moved = moved_(test, [&] { return moved_frame(test.chain); });
    Variant& variant = on_one_thread(subject);
    variant.build(test.chain);
    variant.update(moved);
    const Allocations::Read calls = Allocations::counter();
    const std::uint64_t before = calls();
    variant.update(test.chain);
    variant.update(moved);
    const std::uint64_t made = calls() - before;
    if (made == 0) return std::nullopt;
    return fmt::format("{} allocations in two updates", made);
  }

 private:
  Variant& on_one_thread(const Subject& subject) {
    auto& variant = variants_[subject.info.name];
    if (!variant) {
      const auto name = with_settings(subject.info.name, {{"threads", "1"}});
      variant = name ? StrategyRegistry::instance().make(*name) : subject.make();
    }
    return *variant;
  }

  DerivedFrom<Chain> moved_;
  std::map<std::string, std::unique_ptr<Variant>> variants_;
};

const RegisterProperty<NoAllocation> registered;

}  // namespace
}  // namespace catena::properties

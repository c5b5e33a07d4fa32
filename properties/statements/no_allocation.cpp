#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "catena/properties/allocations.h"
#include "catena/properties/property.h"
#include "catena/properties/statements/moved_frame.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

/// Once warm, by an update to each of two frames, update allocates nothing, and find into the same result
/// nothing either: after one search that found as much, whatever was asked. With one thread, as starting a
/// thread allocates. Asked only in programs that count allocations.
class NoAllocation final : public Property {
 public:
  std::string name() const override { return "no allocation once warm"; }
  bool applies_to(const Subject& subject) const override {
    return Allocations::counter() != nullptr && !subject.info.on_device() && !subject.info.peer &&
           !shares_out(subject);
  }

  std::optional<std::string> check(const Subject& subject, Variant&, const Case& test) override {
    const Chain& moved = moved_(test, [&] { return moved_frame(test.chain); });
    Variant& variant = on_one_thread(subject);
    variant.build(test.chain);
    variant.update(moved);
    variant.update(test.chain);
    const Allocations::Read calls = Allocations::counter();
    const std::uint64_t before = calls();
    variant.update(moved);
    variant.update(test.chain);
    const std::uint64_t made = calls() - before;
    if (made != 0) return fmt::format("{} allocations in two updates", made);
    return in_find(variant, test.chain);
  }

 private:
  /// Ranks and parts are searched by threads however many there are, and what they tell one another is
  /// allocated.
  static bool shares_out(const Subject& subject) {
    return std::ranges::any_of(VariantName::parse(subject.info.name).stages, [](const StageName& stage) {
      const StrategyInfo* const strategy = StrategyRegistry::instance().find_strategy(stage.strategy);
      return strategy != nullptr &&
             std::ranges::any_of(strategy->parameters, [](const ParameterInfo& parameter) {
               return parameter.name == "ranks" || parameter.name == "parts";
             });
    });
  }
  /// A result of its own, so that no larger one of another chain has made the room.
  static std::optional<std::string> in_find(Variant& variant, const Chain& chain) {
    using enum Request::Want;
    Collisions found;
    variant.find(chain, {}, found);
    const Allocations::Read calls = Allocations::counter();
    for (const auto& [want, name] :
         {std::pair{pairs, "pairs"}, {counts, "counts"}, {any, "any"}, {pairs, "pairs"}}) {
      const std::uint64_t before = calls();
      variant.find(chain, {want}, found);
      const std::uint64_t made = calls() - before;
      if (made != 0) return fmt::format("{} allocations in a find of {}", made, name);
    }
    return std::nullopt;
  }

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

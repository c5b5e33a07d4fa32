#include <fmt/format.h>

#include <map>

#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

/// One thread or many: the same set of pairs and the same counts, in the same order where the strategy
/// promises it. For host variants with a parameter `threads`. How many they are is left to the chain's
/// length, as starting threads is most of the cost.
class Threads final : public Property {
 public:
  std::string name() const override { return "any number of threads"; }
  bool applies_to(const Subject& subject) const override {
    return !subject.info.on_device() && with_settings(subject.info.name, {{"threads", "1"}}).has_value();
  }

  std::optional<std::string> check(const Subject& subject, Variant&, const Case& test) override {
    const char* const many = numbers[test.chain.size() % std::size(numbers)];
    run(team(subject, "1"), test.chain, alone_);
    run(team(subject, many), test.chain, together_);
    if (!subject.info.promises.same_order) sort(together_.pairs), sort(alone_.pairs);
    if (together_.pairs != alone_.pairs)
      return fmt::format("{} threads give {} pairs, one gives {}, or {} differ", many, together_.pairs.size(),
                         alone_.pairs.size(),
                         subject.info.promises.same_order ? "they or their order" : "they");
    if (together_.count != alone_.count) return fmt::format("{} threads give other counts than one", many);
    return std::nullopt;
  }

 private:
  static constexpr const char* numbers[] = {"2", "3", "7"};

  Variant& team(const Subject& subject, const std::string& threads) {
    auto& variant = teams_[{subject.info.name, threads}];
    if (!variant)
      variant = StrategyRegistry::instance().make(*with_settings(subject.info.name, {{"threads", threads}}));
    return *variant;
  }

  static void run(Variant& variant, const Chain& chain, Collisions& found) {
    variant.build(chain);
    variant.find(chain, {}, found);
  }

  std::map<std::pair<std::string, std::string>, std::unique_ptr<Variant>> teams_;
  Collisions alone_, together_;
};

const RegisterProperty<Threads> registered;

}  // namespace
}  // namespace catena::properties

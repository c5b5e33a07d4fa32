#include <fmt/format.h>

#include <map>

#include "catena/properties/property.h"
#include "catena/properties/variant_name.h"

namespace catena::properties {
namespace {

/// One thread or many: the same pairs in the same order, the same counts. For host variants with a parameter
/// `threads`; the host executor promises the order too.
class Threads final : public Property {
 public:
  std::string name() const override { return "any number of threads"; }
  bool applies_to(const Subject& subject) const override {
    return !subject.info.on_device && with_settings(subject.info.name, {{"threads", "1"}}).has_value();
  }

  std::optional<std::string> check(const Subject& subject, Variant&, const Case& test) override {
    auto& team = teams_[subject.info.name];
    if (team.empty())
      for (const char* threads : counts)
        team.push_back(
            StrategyRegistry::instance().make(*with_settings(subject.info.name, {{"threads", threads}})));
    run(*team[0], test.chain, alone_);
    for (std::size_t k = 1; k < team.size(); ++k) {
      run(*team[k], test.chain, together_);
      if (together_.pairs != alone_.pairs)
        return fmt::format("{} threads give {} pairs, one gives {}, or the order differs", counts[k],
                           together_.pairs.size(), alone_.pairs.size());
      if (together_.count != alone_.count)
        return fmt::format("{} threads give other counts than one", counts[k]);
    }
    return std::nullopt;
  }

 private:
  static constexpr const char* counts[] = {"1", "2", "7"};

  static void run(Variant& variant, const Chain& chain, Collisions& found) {
    variant.build(chain);
    variant.find(chain, {}, found);
  }

  std::map<std::string, std::vector<std::unique_ptr<Variant>>> teams_;
  Collisions alone_, together_;
};

const RegisterProperty<Threads> registered;

}  // namespace
}  // namespace catena::properties

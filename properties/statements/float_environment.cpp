#include "catena/properties/float_environment.h"

#include "catena/properties/property.h"
#include "catena/reference/compare.h"

namespace catena::properties {
namespace {

/// The same answer in a program that flushes subnormal numbers to zero, rounds otherwise and traps infinity:
/// chain, tree and search are made in the default environment, and the caller gets its own back.
class FloatEnvironment final : public Property {
 public:
  std::string name() const override { return "any floating-point environment"; }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    for (const int rounding : {FE_UPWARD, FE_TOWARDZERO}) {
      Chain again;
      bool kept = false;
      {
        const StrangeFloats floats(rounding);
        const auto spheres = test.chain.spheres();
        again = Chain({spheres.begin(), spheres.end()}, test.chain.strands(), test.chain.exclusion());
        variant.build(again);
        variant.find(again, {}, found_);
        variant.update(again);
        kept = floats.stand();
      }
      if (!kept) return "the caller's environment is lost";
      const auto c = reference::compare(test.chain, test.exact, found_);
      if (!c.right() && (subject.exact() || !c.well_formed())) return "another answer";
    }
    return std::nullopt;
  }

 private:
  Collisions found_;
};

const RegisterProperty<FloatEnvironment> registered;

}  // namespace
}  // namespace catena::properties

#include <stdexcept>

#include "catena/properties/property.h"
#include "catena/reference/compare.h"

namespace catena::properties {
namespace {

/// A search without a build is a programming error that is said, or, where no build is needed, the right
/// answer; never an answer for another chain.
class BuildFirst final : public Property {
 public:
  std::string name() const override { return "build first"; }

  std::optional<std::string> check(const Subject& subject, Variant&, const Case& test) override {
    const auto fresh = subject.make();
    if (auto fault = search(subject, *fresh, test)) return "never built: " + *fault;
    // Shorter where it can be, so that no declared limit is in the way.
    const std::uint32_t n = test.chain.size();
    const Chain other(std::vector<Sphere>(n > 1 ? n - 1 : n + 1, Sphere{0, 0, 0, 1}));
    fresh->build(other);
    if (auto fault = search(subject, *fresh, test)) return "built on another chain: " + *fault;
    return std::nullopt;
  }

 private:
  std::optional<std::string> search(const Subject& subject, Variant& variant, const Case& test) {
    try {
      variant.find(test.chain, {}, found_);
    } catch (const std::logic_error&) {
      return std::nullopt;
    }
    const auto c = reference::compare(test.chain, test.exact, found_);
    if (c.right() || (!subject.exact() && c.well_formed())) return std::nullopt;
    return "an answer that is not this chain's";
  }

  Collisions found_;
};

const RegisterProperty<BuildFirst> registered;

}  // namespace
}  // namespace catena::properties

#include <fmt/format.h>

#include "catena/properties/property.h"
#include "catena/reference/compare.h"

namespace catena::properties {
namespace {

/// The pair set is exactly the reference's, each pair once, counts and totals with it. A rounded arithmetic
/// must still give a well-formed answer; its counts may contradict its pairs, as with rounded bounds sphere i
/// may find j and j not find i.
class PairSet final : public Property {
 public:
  std::string name() const override { return "pair set"; }
  bool every_chain() const override { return true; }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    variant.build(test.chain);
    variant.find(test.chain, {}, found_);
    const auto c = reference::compare(test.chain, test.exact, found_);
    if (c.right()) return std::nullopt;
    if (!subject.exact() && c.well_formed()) return std::nullopt;
    return fmt::format("{} pairs missing, {} invented, {} repeated, {} malformed, {} counts wrong", c.missing,
                       c.invented, c.repeated, c.malformed, c.wrong_counts);
  }

 private:
  Collisions found_;
};

const RegisterProperty<PairSet> registered;

}  // namespace
}  // namespace catena::properties

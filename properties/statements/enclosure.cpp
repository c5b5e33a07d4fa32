#include "catena/reference/enclosure.h"

#include <fmt/format.h>

#include "catena/properties/property.h"

namespace catena::properties {
namespace {

/// Every node encloses all spheres below it, and in the paper's trees the bounds of its children, in exact
/// arithmetic, with no tolerance; every leaf is the chain's sphere. For rounded arithmetic only the leaves
/// are asked.
class Enclosure final : public Property {
 public:
  std::string name() const override { return "enclosure"; }

  std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) override {
    variant.build(test.chain);
    reference::EnclosureChecker checker(test.chain);
    variant.visit_bounds(checker);
    const auto report = checker.report();
    if (report.foreign_leaves > 0)
      return fmt::format("{} leaves are not the chain's spheres", report.foreign_leaves);
    if (report.misplaced > 0) return fmt::format("{} nodes have not one place and bound", report.misplaced);
    if (!subject.exact() || report.violations == 0) return std::nullopt;
    return fmt::format("{} of {} bounds do not enclose, the worst by {:g} of its radius", report.violations,
                       report.bounds, report.worst_shortfall);
  }
};

const RegisterProperty<Enclosure> registered;

}  // namespace
}  // namespace catena::properties

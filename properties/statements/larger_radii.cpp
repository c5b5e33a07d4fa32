#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"

namespace catena::properties {
namespace {

/// Larger radii only add pairs: none of the old ones goes. Not for arc windows, where they add neighbours
/// too.
class LargerRadii final : public Property {
 public:
  std::string name() const override { return "larger radii only add pairs"; }
  bool applies_to(const Subject& subject) const override { return subject.exact(); }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    if (test.chain.exclusion().rule == Exclusion::Rule::arc_window) return std::nullopt;
    const Chain& grown = grown_(test, [&] { return test.chain.moved(larger(test.chain)); });
    variant.build(grown);
    variant.find(grown, {}, found_);
    sort(found_.pairs);
    if (std::ranges::includes(found_.pairs, test.exact.pairs)) return std::nullopt;
    return fmt::format("of {} pairs {} are left, with others, when radii grow", test.exact.pairs.size(),
                       found_.pairs.size());
  }

 private:
  /// Every third sphere by one ulp, every third by half, the others not.
  static std::vector<Sphere> larger(const Chain& chain) {
    std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
    constexpr float largest = std::numeric_limits<float>::max();
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      float& radius = spheres[i].radius;
      if (i % 3 == 0) radius = std::nextafter(radius, largest);
      if (i % 3 == 1) radius = std::min(largest, radius + radius / 2);
    }
    return spheres;
  }

  DerivedFrom<Chain> grown_;
  Collisions found_;
};

const RegisterProperty<LargerRadii> registered;

}  // namespace
}  // namespace catena::properties

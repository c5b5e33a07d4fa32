#include <cmath>

#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// Numbers times a power of two, where none rounds or overflows: the same pairs. Arc windows scale with them.
class Scaling final : public Relation {
 public:
  std::string name() const override { return "scaling by a power of two"; }

  std::optional<Image> image(const Case& test) const override {
    for (const int exponent : {90, -90, 31, -31, 7, -7, 1, -1})
      if (auto spheres = scaled(test.chain, exponent))
        return Image{test.chain.moved(std::move(*spheres)), test.exact.pairs};
    return std::nullopt;
  }

 private:
  static std::optional<std::vector<Sphere>> scaled(const Chain& chain, int exponent) {
    if (chain.exclusion().rule == Exclusion::Rule::arc_window) return std::nullopt;  // moved() keeps the arcs
    std::vector<Sphere> spheres(chain.spheres().begin(), chain.spheres().end());
    for (Sphere& s : spheres)
      for (float* number : {&s.x, &s.y, &s.z, &s.radius}) {
        const float value = std::ldexp(*number, exponent);
        if (!std::isfinite(value) || std::ldexp(value, -exponent) != *number) return std::nullopt;
        *number = value;
      }
    return spheres;
  }
};

const RegisterProperty<Scaling> registered;

}  // namespace
}  // namespace catena::properties

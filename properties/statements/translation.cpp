#include <cmath>

#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// The exact sum, where it is a float.
std::optional<float> exact_sum(float a, float b) {
  const float sum = a + b, part = sum - a;
  const float error = (a - (sum - part)) + (b - part);  // Knuth's two_sum: exact unless it overflows
  if (!std::isfinite(sum) || error != 0) return std::nullopt;
  return sum;
}

/// All spheres moved by the same step, where no coordinate rounds: the same pairs.
class Translation final : public Relation {
 public:
  std::string name() const override { return "exact translation"; }

  std::optional<Image> image(const Case& test) const override {
    if (test.chain.size() == 0) return std::nullopt;
    const Sphere& first = test.chain[0];
    // To the origin, by its mirror image, or by a round number.
    for (const Sphere& step :
         {Sphere{-first.x, -first.y, -first.z, 0}, Sphere{first.x, first.y, first.z, 0},
          Sphere{1024, -512, 256, 0}, Sphere{0.5f, 1, -2, 0}, Sphere{0x1p-149f, 0, 0, 0}})
      if (auto spheres = moved(test.chain, step))
        return Image{test.chain.moved(std::move(*spheres)), test.exact.pairs};
    return std::nullopt;
  }

 private:
  static std::optional<std::vector<Sphere>> moved(const Chain& chain, const Sphere& step) {
    std::vector<Sphere> spheres;
    spheres.reserve(chain.size());
    bool changed = false;
    for (const Sphere& s : chain.spheres()) {
      const auto x = exact_sum(s.x, step.x), y = exact_sum(s.y, step.y), z = exact_sum(s.z, step.z);
      if (!x || !y || !z) return std::nullopt;
      spheres.push_back({*x, *y, *z, s.radius});
      changed |= !(spheres.back() == s);
    }
    if (!changed) return std::nullopt;
    return spheres;
  }
};

const RegisterProperty<Translation> registered;

}  // namespace
}  // namespace catena::properties

#include "catena/properties/statements/relation.h"

namespace catena::properties {
namespace {

/// Axes permuted and negated: the same pairs. The chain is `moved`, so an arc window keeps its lengths.
class Axes final : public Relation {
 public:
  std::string name() const override { return "permuted and negated axes"; }

  std::optional<Image> image(const Case& test) const override {
    std::vector<Sphere> spheres;
    spheres.reserve(test.chain.size());
    const bool other_turn = test.chain.size() % 2 != 0;
    for (const Sphere& s : test.chain.spheres())
      spheres.push_back(other_turn ? Sphere{s.y, -s.z, s.x, s.radius} : Sphere{-s.z, s.x, -s.y, s.radius});
    return Image{test.chain.moved(std::move(spheres)), test.exact.pairs};
  }
};

const RegisterProperty<Axes> registered;

}  // namespace
}  // namespace catena::properties

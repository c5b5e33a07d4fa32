#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "catena/core/sphere.h"

namespace catena::properties {

/// A finite world: every sphere is one of `states`, a place of a small grid with one of a few radii.
struct World {
  std::string name;
  int width, height, depth;  ///< places 0..width-1 along x, and so on
  std::vector<float> radii;
};

/// Every chain of n spheres of the world, but for its mirror images: of the chains that a symmetry of the
/// grid (axes of equal length permuted, axes reversed) or reversing the chain turns into each other only one
/// is visited. The images are counted, so that the sum over all visits is states^n: nothing is left out.
class SmallScope {
 public:
  explicit SmallScope(const World& world);

  std::uint64_t states() const { return spheres_.size(); }
  std::uint64_t symmetries() const { return 2 * images_.size(); }  ///< with the reversed ones

  struct Sum {
    std::uint64_t visited = 0;    ///< chains that are no image of an earlier one
    std::uint64_t stood_for = 0;  ///< chains that they stand for, themselves among them
  };
  /// visit(spheres) for each; false stops.
  Sum for_each(std::uint32_t n, const std::function<bool(const std::vector<Sphere>&)>& visit) const;

 private:
  using State = std::uint8_t;
  struct Walk;

  std::vector<Sphere> spheres_;             ///< by state
  std::vector<std::vector<State>> images_;  ///< for each symmetry of the grid the image of each state
};

}  // namespace catena::properties

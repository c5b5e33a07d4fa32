#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/vec3.h"
#include "catena/core/sphere.h"
#include "catena/core/parameters/parameters.h"

namespace catena {

/// The parameters that every scene has, and the one way from a scene's working units to stored spheres.
///
/// A scene works in binary64, in units in which the radius is 1, centred at the origin and aligned with the
/// axes. A centre p is stored as scale * (radius * R p + offset), where R is a fixed rotation into general
/// position (the identity for align=axes), rounded once to binary32; the radius as scale * radius.
class SceneSetup {
 public:
  /// n, radius, spacing, align, offset, scale with their defaults and meaning, for the registry.
  static const std::vector<ParameterInfo>& declared();

  /// Throws InputError for a value out of its range, or a radius that overflows binary32. `scene` is the name
  /// in messages.
  SceneSetup(std::string scene, const Parameters& parameters);

  std::uint32_t n() const noexcept { return n_; }       ///< number of spheres, 0..2^31-1
  double spacing() const noexcept { return spacing_; }  ///< between neighbours along the tube, in radii
  const std::string& scene() const noexcept { return scene_; }

  /// The stored sphere around a centre in working units. Throws InputError, naming the parameter at fault,
  /// when a coordinate overflows binary32; one that underflows rounds like any other.
  Sphere place(const Vec3& centre) const;
  /// The same with `size` >= 0 times the scene's radius. The radius may overflow too.
  Sphere place(const Vec3& centre, double size) const;

 private:
  [[noreturn]] void refuse(double coordinate) const;
  float stored(double radius) const;

  std::string scene_;
  std::uint32_t n_;
  double radius_, spacing_, offset_, scale_;
  bool aligned_;
  float stored_radius_;
};

}  // namespace catena

#include "catena/core/scenes/setup.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "catena/core/error.h"

namespace catena {
namespace {

constexpr double float_max = std::numeric_limits<float>::max();
constexpr double huge = 1e300;  // far beyond binary32, and products of two still tell which one was too large

// The rotation of the quaternion (8, 1, 4, 5): rational, so that no rounding of a sine decides a bit, and no
// entry is near 0 or 1, so that a plane or line of a scene is far from every axis and every coordinate plane.
Vec3 turned(const Vec3& p) {
  return {(24 * p.x - 72 * p.y + 74 * p.z) / 106, (88 * p.x + 54 * p.y + 24 * p.z) / 106,
          (-54 * p.x + 56 * p.y + 72 * p.z) / 106};
}

}  // namespace

const std::vector<ParameterInfo>& SceneSetup::declared() {
  static const std::vector<ParameterInfo> parameters{
      {"n", "10000", "number of spheres"},
      {"radius", "1", "radius of every sphere, in length units"},
      {"spacing", "1.6", "distance of neighbours along the tube, in radii"},
      {"align", "general", "general: turned by a fixed rotation into general position; axes: not turned"},
      {"offset", "0", "added to every coordinate, in length units"},
      {"scale", "1", "factor on every coordinate and radius, after the offset"}};
  return parameters;
}

SceneSetup::SceneSetup(std::string scene, const Parameters& parameters)
    : scene_(std::move(scene)),
      n_(static_cast<std::uint32_t>(parameters.unsigned_integer("n", 0, (std::uint64_t{1} << 31) - 1))),
      radius_(parameters.real("radius", 1 / huge, huge)),
      spacing_(parameters.real("spacing", 0.05, 100)),
      offset_(parameters.real("offset", -huge, huge)),
      scale_(parameters.real("scale", 1 / huge, huge)),
      aligned_(parameters.choice("align", {"general", "axes"}) == "axes") {
  if (!(radius_ * scale_ <= float_max))
    throw InputError(fmt::format("scene {}: the radius overflows binary32 (at most {:g}); lower {}", scene_,
                                 float_max, radius_ <= float_max ? "scale" : "radius"));
  stored_radius_ = stored(radius_ * scale_);
}

float SceneSetup::stored(double radius) const {
  const auto stored = static_cast<float>(radius);
  if (stored == 0 && radius > 0)
    throw InputError(fmt::format("scene {}: the radius {:g} underflows binary32 (at least {:g}); raise {}",
                                 scene_, radius, std::numeric_limits<float>::denorm_min(),
                                 scale_ < 1 ? "scale" : "radius"));
  return stored;
}

Sphere SceneSetup::place(const Vec3& centre) const {
  const Vec3 p = aligned_ ? centre : turned(centre);
  const double x = scale_ * (radius_ * p.x + offset_), y = scale_ * (radius_ * p.y + offset_),
               z = scale_ * (radius_ * p.z + offset_);
  if (!(std::abs(x) <= float_max)) refuse(p.x);
  if (!(std::abs(y) <= float_max)) refuse(p.y);
  if (!(std::abs(z) <= float_max)) refuse(p.z);
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), stored_radius_};
}

Sphere SceneSetup::place(const Vec3& centre, double size) const {
  Sphere sphere = place(centre);
  const double radius = scale_ * (radius_ * size);
  if (!(radius <= float_max)) refuse(size);
  sphere.radius = stored(radius);
  return sphere;
}

void SceneSetup::refuse(double coordinate) const {
  const double sized = radius_ * coordinate;
  const char* fault = !(std::abs(sized) <= float_max)             ? "radius"
                      : !(std::abs(sized + offset_) <= float_max) ? "offset"
                                                                  : "scale";
  throw InputError(fmt::format("scene {}: a coordinate overflows binary32 (at most {:g}); lower {}", scene_,
                               float_max, fault));
}

}  // namespace catena

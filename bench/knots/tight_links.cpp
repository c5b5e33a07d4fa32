#include "catena/bench/knots/tight_links.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catena/core/vec3.h"

namespace catena::bench {
namespace {

constexpr double pi = std::numbers::pi, radius = 2;  // of every circle, in thicknesses

/// Vertices of closed components, one after the other.
class Components {
 public:
  void add(const Vec3& p) {
    const Sphere s{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0};
    blur_ = std::max(blur_, length(Vec3{s.x - p.x, s.y - p.y, s.z - p.z}));
    spheres_.push_back(s);
  }
  void end() {
    strands_.first.push_back(static_cast<std::uint32_t>(spheres_.size()));
    strands_.closed.push_back(1);
  }
  /// A circle in the plane of x and z about (x, 0, 0), from its nearest to the origin on (`way` is its sign
  /// of x).
  void add_circle(std::uint32_t n, double x, double way) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const double angle = 2 * pi * k / n;
      add({x - way * radius * std::cos(angle), 0, radius * std::sin(angle)});
    }
    end();
  }
  TightLink link() { return {Chain(std::move(spheres_), std::move(strands_)), blur_}; }

 private:
  std::vector<Sphere> spheres_;
  Strands strands_{{0}, {}};
  double blur_ = 0;
};

}  // namespace

TightLink hopf_link(std::uint32_t n) {
  Components link;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double angle = 2 * pi * k / n;
    link.add({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  link.end();
  link.add_circle(n, 2, 1);
  return link.link();
}

TightLink chain_of_three(std::uint32_t n) {
  Components link;
  const std::uint32_t half = n / 2;
  const auto along = static_cast<std::uint32_t>(std::ceil(2 / (pi * radius / half)));  // vertices of a side
  for (const double way : {1.0, -1.0}) {
    const double middle = way > 0 ? 2 : 0;
    for (std::uint32_t k = 0; k < half; ++k) {
      const double angle = pi * k / half;
      link.add({middle + way * radius * std::sin(angle), -way * radius * std::cos(angle), 0});
    }
    for (std::uint32_t k = 0; k < along; ++k) link.add({middle - way * 2 * k / along, way * radius, 0});
  }
  link.end();
  link.add_circle(n, -2, -1);
  link.add_circle(n, 4, 1);
  return link.link();
}

}  // namespace catena::bench

#pragma once
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "catena/core/sphere.h"

/// Generators of finite binary32 and binary64 numbers and spheres where arithmetic goes wrong: for tests
/// only.
namespace catena::reference::testing {

/// Any finite number by its bits: every exponent is as likely as every other, subnormals and zeros included.
inline rc::Gen<float> any_float() {
  return rc::gen::map(rc::gen::arbitrary<std::uint32_t>(), [](std::uint32_t bits) {
    const auto v = std::bit_cast<float>(bits);
    return std::isfinite(v) ? v : std::bit_cast<float>(bits & 0x807FFFFFu);
  });
}
inline rc::Gen<double> any_double() {
  return rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [](std::uint64_t bits) {
    const auto v = std::bit_cast<double>(bits);
    return std::isfinite(v) ? v : std::bit_cast<double>(bits & 0x800FFFFFFFFFFFFFu);
  });
}

/// v, or a float one or two steps away: what turns touching into nearly touching.
inline float nudged(float v, int steps) {
  for (; steps > 0; --steps) v = std::nextafter(v, std::numeric_limits<float>::max());
  for (; steps < 0; ++steps) v = std::nextafter(v, -std::numeric_limits<float>::max());
  return v;
}

/// Spheres of a small integer lattice, scaled by a power of two and sometimes nudged: many ties and near
/// ties, at every scale from subnormal to 2^120, with radii of 0.
inline rc::Gen<Sphere> lattice_sphere(int exponent) {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(-6, 7), rc::gen::inRange(-6, 7), rc::gen::inRange(-6, 7),
                     rc::gen::inRange(0, 4), rc::gen::inRange(-8, 9)),
      [exponent](const auto& t) {
        const auto [x, y, z, r, steps] = t;
        const auto at = [&](int k) { return std::ldexp(static_cast<float>(k), exponent); };
        return Sphere{nudged(at(x), std::abs(steps) <= 2 ? steps : 0), at(y), at(z), at(r)};
      });
}
inline rc::Gen<Sphere> any_sphere() {
  return rc::gen::map(rc::gen::tuple(any_float(), any_float(), any_float(), any_float()), [](const auto& t) {
    return Sphere{std::get<0>(t), std::get<1>(t), std::get<2>(t), std::fabs(std::get<3>(t))};
  });
}

/// Two spheres, the sum of whose radii is their distance, rounded: as near to a tie as floats allow.
inline rc::Gen<std::pair<Sphere, Sphere>> nearly_touching_spheres() {
  const auto distance = [](const Sphere& a, const Sphere& b) {
    return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
  };
  const auto drawn = rc::gen::suchThat(
      rc::gen::tuple(any_sphere(), any_sphere(), rc::gen::inRange(0, 9), rc::gen::inRange(-1, 2)),
      [distance](const auto& t) {
        return distance(std::get<0>(t), std::get<1>(t)) < std::numeric_limits<float>::max();
      });
  return rc::gen::map(drawn, [distance](const auto& t) {
    auto [a, b, eighths, steps] = t;
    const double apart = distance(a, b);
    a.radius = static_cast<float>(apart * eighths / 8);
    b.radius = std::fabs(nudged(static_cast<float>(std::max(0.0, apart - a.radius)), steps));
    return std::pair(a, b);
  });
}

/// Many spheres: one lattice, lattices of two scales, or any numbers at all.
inline rc::Gen<std::vector<Sphere>> nasty_spheres() {
  return rc::gen::mapcat(
      rc::gen::tuple(rc::gen::inRange(0, 4), rc::gen::inRange(-149, 121), rc::gen::inRange(0, 30)),
      [](const auto& t) {
        const auto [kind, exponent, apart] = t;
        const auto lattice = lattice_sphere(exponent);
        const auto finer = lattice_sphere(std::max(exponent - apart, -149));
        const auto one = kind == 0   ? lattice
                         : kind == 1 ? rc::gen::oneOf(lattice, finer)
                         : kind == 2 ? rc::gen::oneOf(lattice, finer, any_sphere())
                                     : any_sphere();
        return rc::gen::container<std::vector<Sphere>>(one);
      });
}

}  // namespace catena::reference::testing

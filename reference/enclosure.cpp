#include "catena/reference/enclosure.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace catena::reference {
namespace {

namespace mp = boost::multiprecision;
// Binary64 numbers are integer multiples of 2^-1074 below 2^1024: 2098 bits. A difference takes 2099 and the
// sum of three squares 4200, so this never overflows; arithmetic costs by the bits in use, and nothing is
// allocated.
using Integer =
    mp::number<mp::cpp_int_backend<4224, 4224, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
using Real = mp::cpp_bin_float_quad;  // 113 bits, exponents to 2^16383: squares of binary64 neither overflow
                                      // nor underflow

bool finite(const Sphere64& s) {
  return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius);
}
bool has_nan(const Sphere64& s) {
  return std::isnan(s.x) || std::isnan(s.y) || std::isnan(s.z) || std::isnan(s.radius);
}

/// Finite numbers with radii >= 0, or an answer that needs no arithmetic.
enum class Case { no, yes, finite };
Case easy(const Sphere64& parent, const Sphere64& child) {
  if (has_nan(parent) || has_nan(child) || parent.radius < 0 || child.radius < 0) return Case::no;
  if (std::isinf(parent.radius)) return Case::yes;
  return finite(parent) && finite(child) ? Case::finite : Case::no;
}

/// q = |cP - cC|^2 and s = rP - rC as integers over one power of two.
struct Scaled {
  Integer q, s;
  int unit;  ///< s is in units of 2^unit, q in units of 2^(2 unit)
};

Scaled scaled(const Sphere64& p, const Sphere64& c) {
  const std::array<double, 8> numbers{p.x, p.y, p.z, p.radius, c.x, c.y, c.z, c.radius};
  std::array<std::int64_t, 8> mantissa;
  std::array<int, 8> exponent;
  int unit = std::numeric_limits<int>::max();
  for (std::size_t k = 0; k < 8; ++k) {
    mantissa[k] = static_cast<std::int64_t>(std::ldexp(std::frexp(numbers[k], &exponent[k]), 53));
    exponent[k] -= 53;
    if (mantissa[k] != 0) unit = std::min(unit, exponent[k]);
  }
  std::array<Integer, 8> v;
  for (std::size_t k = 0; k < 8; ++k)
    if (mantissa[k] != 0) v[k] = Integer(mantissa[k]) << (exponent[k] - unit);
  const Integer dx = v[0] - v[4], dy = v[1] - v[5], dz = v[2] - v[6];
  return {dx * dx + dy * dy + dz * dz, v[3] - v[7], unit};
}

}  // namespace

bool encloses_by_integers(const Sphere64& parent, const Sphere64& child) {
  if (const Case c = easy(parent, child); c != Case::finite) return c == Case::yes;
  if (parent.radius < child.radius) return false;
  const Scaled e = scaled(parent, child);
  return e.q <= e.s * e.s;
}

bool encloses(const Sphere64& parent, const Sphere64& child) {
  if (const Case c = easy(parent, child); c != Case::finite) return c == Case::yes;
  if (parent.radius < child.radius) return false;
  const double dx = parent.x - child.x, dy = parent.y - child.y, dz = parent.z - child.z;
  const double s = parent.radius - child.radius;
  const double q = dx * dx + dy * dy + dz * dz, t = s * s;
  // While nothing overflows and t is far from underflow, t has relative error <= 3.01u (u = 2^-53) and q has
  // <= 5.01u, plus at most 2^-1073 lost by squares that underflow, which is below 2^-100 t. 16u covers both.
  constexpr double slack = 1 + 16 * 0x1p-53;
  if (t > 0x1p-900 && t < 0x1p1000 && q < 0x1p1000) {
    if (q * slack < t) return true;
    if (q > t * slack) return false;
  }
  return encloses_by_integers(parent, child);
}

bool separate_by_integers(const Sphere64& a, const Sphere64& b) {
  if (!finite(a) || !finite(b) || a.radius < 0 || b.radius < 0) return false;
  const Scaled e = scaled(a, {b.x, b.y, b.z, -b.radius});  // s = rA + rB
  return e.q > e.s * e.s;
}

bool separate(const Sphere64& a, const Sphere64& b) {
  const double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, s = a.radius + b.radius;
  const double q = dx * dx + dy * dy + dz * dz, t = s * s;
  // Error bounds as in `encloses`. Comparisons with NaN are false and leave it to the exact test.
  constexpr double slack = 1 + 16 * 0x1p-53;
  if (a.radius >= 0 && b.radius >= 0 && t > 0x1p-900 && t < 0x1p1000 && q < 0x1p1000) {
    if (q > t * slack) return true;
    if (q * slack < t) return false;
  }
  return separate_by_integers(a, b);
}

double shortfall(const Sphere64& parent, const Sphere64& child) {
  const Case c = easy(parent, child);
  if (c == Case::yes) return -1;  // an infinite radius
  if (c == Case::no) return std::numeric_limits<double>::infinity();
  const Scaled e = scaled(parent, child);
  if (parent.radius == 0 && !(e.q == 0 && e.s == 0)) return std::numeric_limits<double>::infinity();
  if (parent.radius == 0) return 0;
  // |cP - cC| - s; for s > 0 by (q - s^2) / (|cP - cC| + s), where the difference that cancels is exact.
  const Real distance = sqrt(Real(e.q)), s(e.s);
  const Real out = e.s > 0 ? Real(Integer(e.q - e.s * e.s)) / (distance + s) : Real(distance - s);
  return static_cast<double>(ldexp(out, e.unit) / parent.radius);
}

void EnclosureChecker::edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
                            const AnyBound& child) {
  shape_.add(parent_id, child_id);
  const auto *p = std::get_if<Sphere64>(&parent), *c = std::get_if<Sphere64>(&child);
  if (!facts_.nested || p == nullptr || c == nullptr) {
    if (!tree_) tree_.emplace(chain_);
    return tree_->add(parent_id, parent, child_id, child);
  }
  ++report_.bounds;
  if (!encloses(*p, *c)) {
    ++report_.violations;
    report_.worst_shortfall = std::max(report_.worst_shortfall, shortfall(*p, *c));
  }
  if (child_id < chain_.size()) {
    const Sphere& s = chain_[child_id];
    if (*c != Sphere64{s.x, s.y, s.z, s.radius}) ++report_.foreign_leaves;
  }
}

EnclosureReport EnclosureChecker::report() {
  if (!tree_) return report_;
  tree_->check(facts_.nested);
  const BoundTreeFaults& faults = tree_->faults();
  report_.bounds += faults.bounds;
  report_.violations += faults.unenclosed;
  report_.worst_shortfall = std::max(report_.worst_shortfall, faults.worst_shortfall);
  report_.foreign_leaves += faults.foreign_leaves;
  report_.misplaced += faults.misplaced;
  tree_.reset();
  return report_;
}

}  // namespace catena::reference

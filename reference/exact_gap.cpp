#include "catena/reference/exact_gap.h"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <limits>

namespace catena::reference {
namespace {

// Binary32 numbers are integer multiples of 2^-149 below 2^128: integers below 2^277. A difference takes 278
// bits, q and t 558 bits, and `quotient` shifts by at most 64 more. So 640 bits never overflow, and nothing
// is allocated.
namespace mp = boost::multiprecision;
using Integer =
    mp::number<mp::cpp_int_backend<640, 640, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;

/// v / 2^-149.
Integer units(float v) {
  const auto bits = std::bit_cast<std::uint32_t>(v);
  const std::uint32_t exponent = bits >> 23 & 0xFF, fraction = bits & 0x7FFFFF;
  Integer magnitude = exponent == 0 ? fraction : fraction | 0x800000;  // subnormals have no hidden bit
  if (exponent > 1) magnitude <<= exponent - 1;
  return bits >> 31 ? Integer(-magnitude) : magnitude;
}

struct Squares {
  Integer q, t;  ///< both in units of 2^-298
};

Squares squares(const Sphere& a, const Sphere& b) {
  const Integer dx = units(a.x) - units(b.x), dy = units(a.y) - units(b.y), dz = units(a.z) - units(b.z);
  const Integer reach = units(a.radius) + units(b.radius);
  return {dx * dx + dy * dy + dz * dz, reach * reach};
}

/// numerator / denominator, both > 0, rounded to nearest even once.
double quotient(Integer numerator, const Integer& denominator) {
  // Enough shift for a whole quotient of at least 64 bits; its first 64, the last of them "or anything
  // below", round like the exact quotient when they become a double.
  const int shift =
      std::max(0, static_cast<int>(mp::msb(denominator)) - static_cast<int>(mp::msb(numerator)) + 64);
  numerator <<= shift;
  Integer whole, rest;
  mp::divide_qr(numerator, denominator, whole, rest);
  const unsigned drop = mp::msb(whole) - 63;
  const bool inexact = rest != 0 || mp::lsb(whole) < drop;
  const auto leading = static_cast<std::uint64_t>(Integer(whole >> drop)) | std::uint64_t{inexact};
  return std::ldexp(static_cast<double>(leading), static_cast<int>(drop) - shift);
}

}  // namespace

int gap_sign_by_integers(const Sphere& a, const Sphere& b) noexcept {
  const Squares s = squares(a, b);
  return s.q.compare(s.t) < 0 ? -1 : s.q.compare(s.t) > 0 ? 1 : 0;
}

int gap_sign(const Sphere& a, const Sphere& b) noexcept {
  const auto estimate = GapEstimate::of(a, b);
  if (estimate.certain()) return estimate.gap < 0 ? -1 : 1;
  return gap_sign_by_integers(a, b);
}

double margin(const Sphere& a, const Sphere& b) noexcept {
  const Squares s = squares(a, b);
  if (s.q == s.t) return 0;
  if (s.t == 0) return std::numeric_limits<double>::infinity();
  return quotient(s.q < s.t ? Integer(s.t - s.q) : Integer(s.q - s.t), s.t);
}

}  // namespace catena::reference

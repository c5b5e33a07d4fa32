#pragma once
#include <algorithm>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "catena/core/hierarchy/bound.h"

/// Binary64 numbers as integers over one power of two: what all exact tests of bounds decide with.
namespace catena::reference::exact {

namespace mp = boost::multiprecision;
/// Any size; up to 512 bits, which numbers of one scene need, nothing is allocated.
using Integer = mp::number<
    mp::cpp_int_backend<512, 0, mp::signed_magnitude, mp::unchecked, std::allocator<mp::limb_type>>,
    mp::et_off>;

struct Vector {
  Integer x, y, z;
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const Vector& a, const Integer& s) { return {a.x * s, a.y * s, a.z * s}; }
  bool zero() const { return x.is_zero() && y.is_zero() && z.is_zero(); }
};
inline Integer dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Integer square(const Vector& a) { return dot(a, a); }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A finite number as mantissa * 2^exponent, the mantissa odd or 0.
struct Binary {
  std::int64_t mantissa = 0;
  int exponent = 0;
  explicit Binary(double v) {
    if (v == 0) return;
    mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(v, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    mantissa >>= zeros;
    exponent += zeros - 53;
  }
};

/// The largest power of two of which all numbers shown to it are integer multiples; 1 when none but 0 was.
class Unit {
 public:
  void fit(double v) {
    if (v != 0) exponent_ = std::min(exponent_, Binary(v).exponent);
  }
  void fit(const Vector64& v) { fit(v.x), fit(v.y), fit(v.z); }

  int exponent() const { return exponent_ == unset ? 0 : exponent_; }
  Integer operator()(double v) const {  ///< v / unit, of a number that was shown
    const Binary b(v);
    return b.mantissa == 0 ? Integer(0) : Integer(b.mantissa) << (b.exponent - exponent());
  }
  Vector operator()(const Vector64& v) const { return {(*this)(v.x), (*this)(v.y), (*this)(v.z)}; }

 private:
  static constexpr int unset = std::numeric_limits<int>::max();
  int exponent_ = unset;
};

}  // namespace catena::reference::exact

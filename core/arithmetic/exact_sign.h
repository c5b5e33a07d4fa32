#pragma once
#include <cmath>

#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// The sign of |cA - cB|^2 - (rA + rB)^2 in exact arithmetic, by error-free transformations
/// (two_sum after Knuth 1969, two_prod by a fused multiply-add, expansions after Shewchuk 1997).
/// Any finite Spheres; no term of the sum can overflow or underflow in binary64.
class ExactSign {
 public:
  /// -1: interiors meet, 0: they touch, +1: separate. About 1,500 operations.
  CATENA_HD static int of_gap(const Sphere& a, const Sphere& b) {
    ExactSign sum;
    sum.add_square_of_sum(b.x, -double(a.x), 1.0);
    sum.add_square_of_sum(b.y, -double(a.y), 1.0);
    sum.add_square_of_sum(b.z, -double(a.z), 1.0);
    sum.add_square_of_sum(a.radius, b.radius, -1.0);
    return sum.sign();
  }

 private:
  /// Adds sign * (p + q)^2. p and q are binary32 values, so the low part of p + q has at most 24 bits and its
  /// square is exact.
  CATENA_HD void add_square_of_sum(double p, double q, double sign) {
    const double high = p + q, q_part = high - p, low = (p - (high - q_part)) + (q - q_part);
    add_product(sign * high, high);
    add_product(sign * 2 * high, low);
    add(sign * low * low);
  }
  CATENA_HD void add_product(double p, double q) {
    using std::fma;
    const double high = p * q;
    add(fma(p, q, -high));
    add(high);
  }
  /// Shewchuk's grow-expansion: components stay nonoverlapping and ascend in magnitude.
  CATENA_HD void add(double value) {
    if (value == 0) return;
    int kept = 0;
    for (int k = 0; k < size_; ++k) {
      const double c = component_[k], s = value + c, c_part = s - value;
      const double error = (value - (s - c_part)) + (c - c_part);
      if (error != 0) component_[kept++] = error;
      value = s;
    }
    if (value != 0)
      component_[kept++] = value;  // zeros are left out, so the last component has the sum's sign
    size_ = kept;
  }
  CATENA_HD int sign() const {
    if (size_ == 0) return 0;
    return component_[size_ - 1] > 0 ? 1 : -1;
  }

  double component_[20];  // at most 5 terms for each of the 4 squares
  int size_ = 0;
};

}  // namespace catena

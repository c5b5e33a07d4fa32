#pragma once
#include <boost/multiprecision/cpp_int.hpp>

#include "catena/core/periodic/periodic_box.h"

namespace catena {

/// A sphere and the image of another as whole numbers, exactly: the squared distance of their centres and the
/// sum of their radii, in units of 2^(2 * unit) and 2^unit.
struct ImageSquares {
  // The largest, 2^128 and shifts of 2^22 edges of 2^100, have 53 + 288 digits, their squares' sum less than
  // 704.
  using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
      704, 704, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
  // A binary32 number is a multiple of 2^-149, and so is one of binary64 that is not below 2^-96; the
  // smallest edges take 2^-152.
  static constexpr int unit = -160;

  Integer distance, reach;  ///< the first squared

  /// What image_overlaps takes.
  ImageSquares(const Sphere& a, const Sphere& b, const Shift& shift, const PeriodicBox& box);
};

}  // namespace catena

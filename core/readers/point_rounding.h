#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "catena/core/readers/read_options.h"
#include "catena/core/sphere.h"

namespace catena {

/// Rounds the points of a file to binary32, after an origin was taken off where the user wants that, and
/// keeps how much is lost.
class PointRounding {
 public:
  PointRounding() = default;
  explicit PointRounding(const ReadOptions& options)
      : to_first_(options.recentre && !options.origin),
        origin_(options.recentre ? options.origin : std::nullopt) {}

  Sphere round(double x, double y, double z, float radius) {
    if (to_first_ && !origin_) origin_ = {x, y, z};
    if (origin_) x -= (*origin_)[0], y -= (*origin_)[1], z -= (*origin_)[2];
    const Sphere rounded{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), radius};
    const double error =
        std::max({std::abs(x - rounded.x), std::abs(y - rounded.y), std::abs(z - rounded.z)});
    greatest_error_ = std::max(greatest_error_, error);
    if (radius > 0) greatest_share_ = std::max(greatest_share_, error / radius);
    return rounded;
  }

  double greatest_error() const { return greatest_error_; }  ///< of a coordinate, so far
  double greatest_share() const { return greatest_share_; }  ///< of such an error in the radius of its sphere
  const std::optional<std::array<double, 3>>& origin() const { return origin_; }  ///< what is taken off

 private:
  bool to_first_ = false;
  std::optional<std::array<double, 3>> origin_;
  double greatest_error_ = 0, greatest_share_ = 0;
};

}  // namespace catena

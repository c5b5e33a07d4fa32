#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

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
    const auto [rounded, error] = nearest(x, y, z, radius);
    count(error, radius);
    return rounded;
  }

  /// Of a point whose radius is told later, or which may be left out: it counts when settle() is called.
  Sphere round_open(double x, double y, double z) {
    const auto [rounded, error] = nearest(x, y, z, 0);
    if (error > 0) open_.resize(opened_ + 1), open_.back() = error;
    ++opened_;
    return rounded;
  }

  /// The spheres that became of the points of round_open: sphere k of the point point_of(k), counted from 0.
  template <class PointOf>
  void settle(std::span<const Sphere> spheres, const PointOf& point_of) {
    for (std::size_t k = 0; k < spheres.size() && !open_.empty(); ++k)
      if (const std::size_t point = point_of(k); point < open_.size()) count(open_[point], spheres[k].radius);
    std::exchange(open_, {});  // an assignment would keep the memory
    opened_ = 0;
  }

  double greatest_error() const { return greatest_error_; }  ///< of a coordinate, so far
  double greatest_share() const { return greatest_share_; }  ///< of such an error in the radius of its sphere
  const std::optional<std::array<double, 3>>& origin() const { return origin_; }  ///< what is taken off

 private:
  struct Rounded {
    Sphere sphere;
    double error;
  };

  Rounded nearest(double x, double y, double z, float radius) {
    if (to_first_ && !origin_) origin_ = {x, y, z};
    if (origin_) x -= (*origin_)[0], y -= (*origin_)[1], z -= (*origin_)[2];
    const Sphere rounded{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), radius};
    return {rounded, std::max({std::abs(x - rounded.x), std::abs(y - rounded.y), std::abs(z - rounded.z)})};
  }

  void count(double error, float radius) {
    greatest_error_ = std::max(greatest_error_, error);
    if (radius > 0) greatest_share_ = std::max(greatest_share_, error / radius);
  }

  bool to_first_ = false;
  std::optional<std::array<double, 3>> origin_;
  double greatest_error_ = 0, greatest_share_ = 0;
  std::vector<double> open_;  ///< errors of the open points; none behind the last that is not 0
  std::size_t opened_ = 0;
};

}  // namespace catena

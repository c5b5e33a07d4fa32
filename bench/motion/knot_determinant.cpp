#include "catena/bench/motion/knot_determinant.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace catena::bench {
namespace {

/// Where the curve passes a crossing: how far along it, and whether it is the lower of the two strands there.
struct Passage {
  double along;
  std::size_t crossing;
  bool under;
};

/// The polygon with far ends, turned about x by an angle in no special position: x and y are the picture, z
/// its height.
std::vector<Vec3> picture(std::span<const Vec3> polygon) {
  constexpr double cosine = 0.8047378541243649, sine = 0.5936265929563216;
  std::vector<Vec3> points;
  double widest = 1;
  for (const Vec3& p : polygon) widest = std::max(widest, std::abs(p.x));
  const auto turned = [&](double x, const Vec3& p) {
    return Vec3{x, cosine * p.y - sine * p.z, sine * p.y + cosine * p.z};
  };
  points.push_back(turned(-2 * widest, polygon.front()));
  for (const Vec3& p : polygon) points.push_back(turned(p.x, p));
  points.push_back(turned(2 * widest, polygon.back()));
  return points;
}

double cross(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }

std::vector<Passage> passages(const std::vector<Vec3>& points) {
  std::vector<Passage> found;
  std::size_t crossings = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j) {
      const Vec3 a = points[i + 1] - points[i], b = points[j + 1] - points[j], apart = points[j] - points[i];
      const double area = cross(a, b);
      if (area == 0) continue;
      const double on_a = cross(apart, b) / area, on_b = cross(apart, a) / area;
      if (!(on_a >= 0 && on_a < 1 && on_b >= 0 && on_b < 1)) continue;
      const bool a_under = points[i].z + on_a * a.z < points[j].z + on_b * b.z;
      found.push_back({static_cast<double>(i) + on_a, crossings, a_under});
      found.push_back({static_cast<double>(j) + on_b, crossings, !a_under});
      ++crossings;
    }
  std::ranges::sort(found, {}, &Passage::along);
  return found;
}

}  // namespace

std::uint64_t knot_determinant(std::span<const Vec3> polygon) {
  if (polygon.size() < 2) return 1;
  const std::vector<Passage> walk = passages(picture(polygon));
  const auto crossings = static_cast<Eigen::Index>(walk.size() / 2);
  if (crossings == 0) return 1;
  // The curve between two passages under another strand has one colour. At a crossing, twice the colour above
  // is the sum of the two below.
  Eigen::MatrixXd colouring = Eigen::MatrixXd::Zero(crossings, crossings);
  Eigen::Index colour = 0;
  for (const Passage& p : walk) {
    const auto row = static_cast<Eigen::Index>(p.crossing);
    if (!p.under) {
      colouring(row, colour) += 2;
      continue;
    }
    colouring(row, colour) -= 1;
    colour = (colour + 1) % crossings;
    colouring(row, colour) -= 1;
  }
  const Eigen::Index minor = crossings - 1;
  if (minor == 0) return 1;
  return static_cast<std::uint64_t>(
      std::llround(std::abs(colouring.topLeftCorner(minor, minor).determinant())));
}

}  // namespace catena::bench

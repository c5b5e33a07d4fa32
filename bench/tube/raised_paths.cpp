#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "catena/bench/tube/arc_length.h"
#include "catena/bench/tube/tube.h"
#include "catena/core/scenes/cubic_spline.h"
#include "catena/core/scenes/paper_paths.h"

namespace catena::bench {
namespace {

/// How deep the tube goes through itself at each crossing, in radii: deep, shallow, and just not.
constexpr std::array depths{0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, -1e-3, -0.02};

/// The spline of a path, its later pass of crossing k raised to 2 - depths[k] above the earlier one in a
/// smooth bump.
class RaisedSpline {
 public:
  RaisedSpline(const SnakePath& path, double size, double half)
      : spline_(path.control), size_(size), half_(half) {
    auto crossings = path.crossings;
    std::ranges::sort(crossings, {}, &SnakePath::Crossing::later);
    for (const auto& crossing : crossings) centres_.push_back(spline_.knot(crossing.later));
    for (std::size_t k = 0; k < spline_.points(); ++k) breaks_.push_back(spline_.knot(k));
    for (const double centre : centres_) breaks_.insert(breaks_.end(), {centre - half, centre + half});
    std::ranges::sort(breaks_);
    const auto same = [](double a, double b) { return b - a < 1e-9; };
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end(), same), breaks_.end());
  }

  std::size_t pieces() const { return breaks_.size() - 1; }  ///< polynomials, of equal width in the parameter

  Vec3 position(double t) const {
    Place at = place(t);
    const auto [raised, slope] = bump(at.t);
    return size_ * spline_.position(at.t, at.cursor) + Vec3{0, 0, raised};
  }
  Vec3 derivative(double t) const {
    Place at = place(t);
    const auto [raised, slope] = bump(at.t);
    return at.rate * (size_ * spline_.derivative(at.t, at.cursor) + Vec3{0, 0, slope});
  }

 private:
  struct Place {
    double t, rate;  ///< parameter of the spline, and its change with that from 0 to 1
    CubicSpline::Cursor cursor;
  };
  Place place(double t) const {
    const auto count = static_cast<double>(pieces());
    const double along = std::clamp(t * count, 0.0, count);
    const std::size_t k = std::min(static_cast<std::size_t>(along), pieces() - 1);
    const double width = breaks_[k + 1] - breaks_[k];
    return {breaks_[k] + (along - static_cast<double>(k)) * width,
            width * count,
            {k * spline_.points() / breaks_.size()}};
  }
  /// Height (1 - x^2)^3 and its slope, twice continuously differentiable.
  std::pair<double, double> bump(double t) const {
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const double x = (t - centres_[k]) / half_, y = 1 - x * x, top = 2 - depths[k % depths.size()];
      if (y > 0) return {top * y * y * y, top * -6 * x * y * y / half_};
    }
    return {0, 0};
  }

  CubicSpline spline_;
  double size_, half_;
  std::vector<double> centres_, breaks_;
};

Tube snake_tube(std::string name, const SnakePath& path, double size, double half) {
  const auto curve = std::make_shared<RaisedSpline>(path, size, half);
  const auto arc =
      std::make_shared<ArcLength>([=](double t) { return curve->derivative(t); }, 16 * curve->pieces());
  return {std::move(name), arc->total(), 1, false,
          [=](double s) { return curve->position(arc->parameter(s)); }};
}

}  // namespace

Tube path1_tube() { return snake_tube("path1", path1(), 12, 1.5); }
Tube path2_tube() { return snake_tube("path2", path2(), 8, 2); }

}  // namespace catena::bench

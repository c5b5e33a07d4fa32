// lay_snake: walks the path by arc length and chooses, at each crossing, the bump that gives the wanted
// pairs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "catena/core/scenes/cubic_spline.h"
#include "catena/core/scenes/snake.h"

namespace catena {
namespace {

// In radii, where there is room: the slope of a bump then stays below 1/5.
constexpr double bump_half_width = 24;
// In radii from the crossing: passes that meet at 35 degrees or more touch only within it.
constexpr double reach = 8;
// Candidate bumps at a crossing: 0 to 2 radii up, half a spacing to either side.
constexpr int lifts = 33, shifts = 9;

/// A smooth deviation from the plane path around the parameter `centre`: displacement * (1 - x^2)^3 with
/// x = (t - centre) / half, twice continuously differentiable at both ends.
struct Bump {
  Vec3 displacement;
  double centre = 0, half = 1;

  double shape(double t) const {
    const double x = (t - centre) / half, y = 1 - x * x;
    return y > 0 ? y * y * y : 0;
  }
  double slope(double t) const {
    const double x = (t - centre) / half, y = 1 - x * x;
    return y > 0 ? -6 * x * y * y / half : 0;
  }
};

/// A place on the path.
struct Place {
  double t = 0;
  CubicSpline::Cursor cursor;
};

/// How a candidate bump does at a crossing.
struct Meeting {
  // Overlaps of the two passes; pairs_at_crossing + 1 stands for any larger number.
  int pairs = 0;
  // Least |d^2 - s^2| / s^2 over all spheres of the one pass with those of the other.
  double margin = 0;

  bool better_than(const Meeting& other) const {
    if (pairs > pairs_at_crossing) return false;
    return pairs != other.pairs ? pairs > other.pairs : margin > other.margin;
  }
};

class SnakeLayer {
 public:
  SnakeLayer(const SnakePath& path, const SceneSetup& setup, std::uint32_t count)
      : setup_(setup), count_(count), crossings_(path.crossings), spline_(path.control) {
    std::ranges::sort(crossings_, {}, &SnakePath::Crossing::later);
    size_ = setup.spacing() * count / spline_.arc_length(0, spline_.points() - 1);
    half_ = std::max(bump_half_width, 3 * setup.spacing()) / size_;
    for (std::size_t k = 1; k < crossings_.size(); ++k) {  // the bumps of a tiny snake must not overlap
      const double apart = spline_.knot(crossings_[k].later) - spline_.knot(crossings_[k - 1].later);
      half_ = std::min(half_, apart / 2);
    }
    const auto [low, high] = bounds(path.control);
    centre_ = 0.5 * (low + high);
    passed_.reserve(spline_.points());
  }

  std::vector<Sphere> lay() {
    std::vector<Sphere> row;
    row.reserve(count_);
    std::size_t next = 0;  // crossing whose later pass lies ahead
    for (Place here; row.size() < count_; step(here)) {
      while (passed_.size() < spline_.points() && spline_.knot(passed_.size()) <= here.t)
        passed_.push_back(row.size());
      if (next < crossings_.size() && here.t >= spline_.knot(crossings_[next].later) - half_)
        bump_ = choose(crossings_[next++], here, row);
      row.push_back(setup_.place(position(here)));
    }
    return row;
  }

 private:
  static std::pair<Vec3, Vec3> bounds(const std::vector<Vec3>& points) {
    Vec3 low = points[0], high = points[0];
    for (const Vec3& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    return {low, high};
  }

  Vec3 position(Place& here) const {
    return size_ * (spline_.position(here.t, here.cursor) - centre_) +
           bump_.shape(here.t) * bump_.displacement;
  }

  /// dt/ds: how far the parameter moves per radius of arc length.
  double rate(double t, CubicSpline::Cursor& cursor) const {
    return 1 / length(size_ * spline_.derivative(t, cursor) + bump_.slope(t) * bump_.displacement);
  }

  /// Moves on by one spacing of arc length: a step of the classical Runge-Kutta method for dt/ds = 1/|p'(t)|.
  void step(Place& here) const {
    const double h = setup_.spacing(), t = here.t;
    const double k1 = rate(t, here.cursor), k2 = rate(t + h / 2 * k1, here.cursor),
                 k3 = rate(t + h / 2 * k2, here.cursor), k4 = rate(t + h * k3, here.cursor);
    here.t = t + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }

  /// The bump, starting here, that brings exactly the wanted pairs with the widest margin.
  Bump choose(const SnakePath::Crossing& crossing, Place here, const std::vector<Sphere>& row) {
    const double centre = spline_.knot(crossing.later);
    const Vec3 along = spline_.derivative(centre, here.cursor);
    const Vec3 aside = 1 / length(along) * Vec3{-along.y, along.x, 0};
    Bump best{{0, 0, 2.5}, centre, centre - here.t};  // if all else fails the passes do not touch
    Meeting best_meeting;
    for (int lift = 0; lift < lifts; ++lift)
      for (int shift = 0; shift < shifts; ++shift) {
        const Vec3 displacement =
            setup_.spacing() * (static_cast<double>(shift) / (shifts - 1) - 0.5) * aside +
            Vec3{0, 0, 2.0 * lift / (lifts - 1)};
        bump_ = {displacement, centre, centre - here.t};
        const Meeting meeting = meet(crossing, here, row);
        if (meeting.better_than(best_meeting)) {
          best = bump_;
          best_meeting = meeting;
        }
      }
    return best;
  }

  /// The earlier pass of a crossing, as stored, against the later one under the present bump.
  Meeting meet(const SnakePath::Crossing& crossing, Place here, const std::vector<Sphere>& row) const {
    const auto window = static_cast<std::size_t>(std::ceil(reach / setup_.spacing())) + 1;
    const std::size_t middle = passed_[crossing.earlier];
    const std::size_t first = middle - std::min(middle, window), last = std::min(row.size(), middle + window);
    const double centre = spline_.knot(crossing.later);
    const double near = reach / size_;  // in the parameter; its speed along the path is about 1
    Meeting meeting{0, std::numeric_limits<double>::infinity()};
    for (; here.t < centre + near && here.t < spline_.end(); step(here)) {
      if (here.t < centre - near) continue;
      const Sphere a = setup_.place(position(here));
      for (std::size_t i = first; i < last; ++i) {
        const double excess = relative_excess(a, row[i]);
        meeting.margin = std::min(meeting.margin, std::abs(excess));
        if (excess <= 0 && ++meeting.pairs > pairs_at_crossing) return meeting;
      }
    }
    return meeting;
  }

  /// (d^2 - s^2) / s^2 for centres at distance d and radii of sum s; not above 0 when the two overlap.
  static double relative_excess(const Sphere& a, const Sphere& b) {
    const Vec3 apart{double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
    const double touching = double{a.radius} + b.radius;
    return dot(apart, apart) / (touching * touching) - 1;
  }

  const SceneSetup& setup_;
  std::uint32_t count_;
  std::vector<SnakePath::Crossing> crossings_;  // by their later pass
  CubicSpline spline_;
  double size_ = 0;  // radii per unit of the path
  double half_ = 0;  // half width of a bump, in the parameter
  Vec3 centre_;
  Bump bump_;                        // the last one chosen; none at first
  std::vector<std::size_t> passed_;  // by control point: the first sphere at or after it
};

}  // namespace

std::vector<Sphere> lay_snake(const SnakePath& path, const SceneSetup& setup, std::uint32_t count) {
  if (count == 0) return {};
  return SnakeLayer(path, setup, count).lay();
}

}  // namespace catena

// snake_row: walks the path by arc length and chooses, at each crossing, the bump that gives the wanted
// pairs.
#include <algorithm>
#include <cmath>
#include <deque>
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

/// Lays one sphere after the other. Of those that it laid it keeps the ones near a crossing that is still to
/// be passed again.
class SnakeLayer {
 public:
  SnakeLayer(const SnakePath& path, const SceneSetup& setup, std::uint32_t count)
      : setup_(setup), crossings_(path.crossings), spline_(path.control) {
    std::ranges::sort(crossings_, {}, &SnakePath::Crossing::later);
    earlier_passes_.resize(crossings_.size());
    window_ = static_cast<std::size_t>(std::ceil(reach / setup.spacing())) + 1;
    size_ = setup.spacing() * count / spline_.arc_length(0, spline_.points() - 1);
    half_ = std::max(bump_half_width, 3 * setup.spacing()) / size_;
    for (std::size_t k = 1; k < crossings_.size(); ++k) {  // the bumps of a tiny snake must not overlap
      const double apart = spline_.knot(crossings_[k].later) - spline_.knot(crossings_[k - 1].later);
      half_ = std::min(half_, apart / 2);
    }
    const auto [low, high] = bounds(path.control);
    centre_ = 0.5 * (low + high);
  }

  /// The next sphere.
  Sphere operator()() {
    for (std::size_t k = 0; k < crossings_.size(); ++k)
      if (!earlier_passes_[k].begun && spline_.knot(crossings_[k].earlier) <= here_.t)
        earlier_passes_[k] = {true, window_, {recent_.begin(), recent_.end()}};
    if (next_ < crossings_.size() && here_.t >= spline_.knot(crossings_[next_].later) - half_) {
      bump_ = choose(next_, here_);
      earlier_passes_[next_++] = {.begun = true};
    }
    const Sphere sphere = setup_.place(position(here_));
    step(here_);
    keep(sphere);
    return sphere;
  }

 private:
  /// The spheres at most `window_` before the control point of a crossing, and as many from there on.
  struct EarlierPass {
    bool begun = false;
    std::size_t awaited = 0;  // of those from there on
    std::vector<Sphere> spheres = {};
  };

  void keep(const Sphere& sphere) {
    for (EarlierPass& pass : earlier_passes_)
      if (pass.awaited > 0) pass.spheres.push_back(sphere), --pass.awaited;
    if (recent_.size() == window_) recent_.pop_front();
    recent_.push_back(sphere);
  }

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
  Bump choose(std::size_t crossing, Place here) {
    const double centre = spline_.knot(crossings_[crossing].later);
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
        const Meeting meeting = meet(earlier_passes_[crossing].spheres, centre, here);
        if (meeting.better_than(best_meeting)) {
          best = bump_;
          best_meeting = meeting;
        }
      }
    return best;
  }

  /// The earlier pass of a crossing, as stored, against the later one under the present bump.
  Meeting meet(const std::vector<Sphere>& earlier, double centre, Place here) const {
    const double near = reach / size_;  // in the parameter; its speed along the path is about 1
    Meeting meeting{0, std::numeric_limits<double>::infinity()};
    for (; here.t < centre + near && here.t < spline_.end(); step(here)) {
      if (here.t < centre - near) continue;
      const Sphere a = setup_.place(position(here));
      for (const Sphere& b : earlier) {
        const double excess = relative_excess(a, b);
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

  SceneSetup setup_;
  std::vector<SnakePath::Crossing> crossings_;  // by their later pass
  CubicSpline spline_;
  double size_ = 0;  // radii per unit of the path
  double half_ = 0;  // half width of a bump, in the parameter
  Vec3 centre_;
  std::size_t window_ = 0;  // spheres to either side of a crossing that its later pass is held against
  Place here_;
  Bump bump_;                                // the last one chosen; none at first
  std::size_t next_ = 0;                     // crossing whose later pass lies ahead
  std::vector<EarlierPass> earlier_passes_;  // by crossing
  std::deque<Sphere> recent_;                // the last `window_`
};

}  // namespace

Row snake_row(const SnakePath& path, const SceneSetup& setup, std::uint32_t count) {
  return Row::by_steps(count, [=] { return SnakeLayer(path, setup, count); });
}

}  // namespace catena

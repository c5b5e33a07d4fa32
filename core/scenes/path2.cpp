// path2: a snake on circles (Section 6 and Fig. 13 of the paper).
#include <numbers>

#include "catena/core/scenes/paper_paths.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/snake.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

constexpr std::uint32_t keyframes = 114;
constexpr int loops = 9;
constexpr int lead_points = 28;  // control points of the plain arc before the first loop, and after the last
constexpr double ring = 28;      // radius of the great circle on which the small ones sit
constexpr double pi = std::numbers::pi;
// A wheel of radius 1 rolls along the great circle; a point at this distance from its hub draws the loops.
// With this one a loop crosses itself 3/8 turn before and after its top, where there are control points.
const double arm = 3 * pi / 4 * std::numbers::sqrt2;

/// The point at `along` on the great circle, raised by `out` from it.
Vec3 on_ring(double along, double out) {
  const auto [cosine, sine] = circle_point(along / (2 * pi * ring));
  return {(ring + out) * cosine, (ring + out) * sine, 0};
}

/// Point k of the loops, eight to a turn of the wheel: k = 8m is the top of loop m.
Vec3 on_loop(int k) {
  const auto [cosine, sine] = circle_point(k / 8.0);
  return on_ring(k * pi / 4 - arm * sine, arm * cosine);
}

}  // namespace

SnakePath path2() {
  // From dip to dip: there the path runs along the ring, and plain arcs of it go on.
  constexpr int first = -4, last = 8 * (loops - 1) + 4;
  constexpr double step = pi / 2;
  SnakePath path;
  for (int k = lead_points; k > 0; --k) path.control.push_back(on_ring(first * pi / 4 - k * step, -arm));
  for (int k = first; k <= last; ++k) path.control.push_back(on_loop(k));
  for (int k = 1; k <= lead_points; ++k) path.control.push_back(on_ring(last * pi / 4 + k * step, -arm));
  for (int m = 0; m < loops; ++m) {
    const auto top = static_cast<std::size_t>(lead_points + 8 * m - first);
    path.crossings.push_back({top - 3, top + 3});
  }
  return path;
}

namespace {

const RegisterScene registered{
    {"path2",
     "snake on circles: nine loops on a great circle; 114 frames, at most 45 pairs for n >= 1000 (the paper)",
     {}},
    [](const Parameters& parameters) {
      return open_snake(path2(), SceneSetup("path2", parameters), keyframes);
    }};

}  // namespace
}  // namespace catena

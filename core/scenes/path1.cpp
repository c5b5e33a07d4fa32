// path1: a snake on a sinusoidal path (Section 6 and Fig. 12 of the paper).
#include <numbers>

#include "catena/core/scenes/paper_paths.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/snake.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

constexpr std::uint32_t keyframes = 56;
constexpr int crossings = 9;
constexpr int lead_waves = 6;      // half waves before the first crossing and after the last one
constexpr double amplitude = 2.4;  // the slope at a crossing too, so that the passes meet at 45 degrees
// Below amplitude / 2, so that the way in, on top, and the way off, below, stay apart.
constexpr double lead_amplitude = 0.96;

// Control points are 1/8 wave apart. Point k lies at x = k pi/4; crossing c at k = 4c; the way out begins to
// swing in full at the crest k = 2 and turns back at the trough k = 38.
constexpr int first = 2 - 4 * lead_waves, crest = 2, turn = 4 * crossings + 2;

/// Point k of the way out. The way back is its mirror image: below it before the crest, crossing it after.
Vec3 way_out(int k) {
  const double sine = circle_point(k / 8.0).sine;
  const double y = k < crest ? amplitude - lead_amplitude + lead_amplitude * sine : amplitude * sine;
  return {k * std::numbers::pi / 4, y, 0};
}

}  // namespace

SnakePath path1() {
  SnakePath path;
  for (int k = first; k <= turn; ++k) path.control.push_back(way_out(k));
  const double turn_x = way_out(turn).x;
  // A half circle leads from the trough of the way out up to the crest of the way back.
  for (int k = -1; k <= 1; ++k) {
    const auto [cosine, sine] = circle_point(k / 8.0);
    path.control.push_back({turn_x + amplitude * cosine, amplitude * sine, 0});
  }
  const std::size_t back = path.control.size();
  for (int k = turn; k >= first; --k) path.control.push_back({way_out(k).x, -way_out(k).y, 0});
  for (int c = 1; c <= crossings; ++c)
    path.crossings.push_back(
        {static_cast<std::size_t>(4 * c - first), back + static_cast<std::size_t>(turn - 4 * c)});
  return path;
}

namespace {

const RegisterScene registered{
    {"path1",
     "snake on a sinusoidal path, out and back; 56 frames, at most 45 pairs for n >= 1000 (the paper)",
     {}},
    [](const Parameters& parameters) {
      return open_snake(path1(), SceneSetup("path1", parameters), keyframes);
    }};

}  // namespace
}  // namespace catena

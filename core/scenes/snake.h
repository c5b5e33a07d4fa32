#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "catena/core/scenes/animation.h"
#include "catena/core/scenes/row.h"
#include "catena/core/scenes/setup.h"

namespace catena {

/// The path of a snake: control points in the plane z = 0, in any unit, interpolated by a natural cubic
/// spline. Where the path crosses itself it has the same control point twice; nowhere else may it come near
/// itself.
struct SnakePath {
  struct Crossing {
    std::size_t earlier, later;  ///< indices of the two control points, earlier < later
  };
  std::vector<Vec3> control;
  std::vector<Crossing> crossings;
};

/// Spheres that collide where two passes of the snake cross: 9 crossings then give the paper's 45 pairs.
inline constexpr int pairs_at_crossing = 5;

/// A row of `count` spheres from the start of the path to its end, at equal arc lengths of `setup.spacing()`
/// radii: the path is scaled to that length and centred at the origin. The later pass of a crossing rises by
/// at most 2.5 radii and moves aside by at most half a spacing, in a smooth bump, such that exactly
/// `pairs_at_crossing` pairs of *stored* spheres overlap there. Where no bump does that (a path too small for
/// its bends, spacing far from the default, coordinates too coarse for their distance from the origin) a
/// crossing has fewer pairs. O(count). Its spheres throw InputError when a coordinate overflows.
Row snake_row(const SnakePath& path, const SceneSetup& setup, std::uint32_t count);

/// Opens the animation of a snake that moves along the path by 7/20 of its own length in `frames` frames:
/// frame f is a run of n spheres out of one row laid along the whole path. It therefore moves on by whole
/// spacings, at least one a frame, and two passes meet in every frame exactly as they were laid. The row is
/// laid for the first frame and kept. Throws InputError when the row would have more than 2^31 - 1 spheres;
/// frames do as its spheres.
std::unique_ptr<Animation> open_snake(const SnakePath& path, const SceneSetup& setup, std::uint32_t frames);

}  // namespace catena

#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "catena/core/pair.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/scenes/animation.h"

namespace catena {

/// Which spheres of a tube are enough for a tolerance, and what the others would have added.
///
/// A contact of the tube (see tube_loss) deeper than twice the loss on both sides is found by the kept
/// spheres, unless those two are neighbours; and what they find is found by all spheres, too: arc lengths
/// stay those of the whole tube.
struct Thinning {
  double tolerance = 0;             ///< asked for, as a share of the radius
  std::uint32_t spheres = 0;        ///< before
  std::vector<std::uint32_t> kept;  ///< ascending; of every strand the first and the last are
  double lost = 0;  ///< most tube_loss of a stretch that leaves spheres out, as a share of its least radius
  double own = 0;   ///< most between two consecutive spheres of the input, where nothing is left out

  bool keeps(std::uint32_t sphere) const;
  /// The new index of a sphere that is kept; of any other that of the next one that is. O(log kept).
  std::uint32_t place_of(std::uint32_t sphere) const;
};

/// The spheres to keep in every frame alike: as few as a walk along each strand finds that goes as far as
/// `tolerance`, above 0 and below 1, lets it. The spheres of joints stay. Throws InputError unless the rule
/// is an arc window, as an index window counts the spheres between. O(n log(spheres left out in a row)) for
/// each frame, which is made once, and once more where a frame needs spheres that frame 0 does not. Where
/// boxes repeat space, one a frame or one for all, a step across a face is one to the nearest image; the
/// spheres on both of its sides stay.
Thinning thin(const Animation& whole, std::span<const Pair> joints, double tolerance,
              std::span<const PeriodicBox> boxes = {});

/// The same frames with the kept spheres only.
std::unique_ptr<Animation> thinned(std::unique_ptr<Animation> whole, const Thinning& thinning);

}  // namespace catena

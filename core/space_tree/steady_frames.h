#pragma once
#include <array>
#include <cstdint>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/sphere.h"

namespace catena {

/// Whether what a look told of a frame still holds of a later one: some spheres all along the chain, 64 at
/// most, lie about where they did. It does for some frames only, as what moves where no sample is changes
/// little at a time.
class CATENA_API SteadyFrames {
 public:
  /// A look was taken at this frame.
  void looked(const ChainView& chain);
  /// Whether that holds of this one, of as many spheres. Next to nothing.
  bool still(const ChainView& chain);

 private:
  static constexpr std::uint32_t most_samples = 64;
  std::array<Sphere, most_samples> sample_;
  std::uint32_t samples_ = 0, spheres_ = 0, frames_ = 0;  // frames: since the look
};

}  // namespace catena

#pragma once
#include <cstdint>
#include <cstring>

#include "catena/core/cells/counter.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/host_device.h"

namespace catena {

/// The box around all spheres of a level, each in its own (Box::around), to which many threads add in any
/// order. Its ends are kept as numbers in the order of the floats, the lower ones of -low, so that all of
/// them only rise; at first 0, which is below all, and the box of no spheres.
class LevelBox {
 public:
  static constexpr std::uint32_t ends = 6;

  /// The ends that the box around some spheres must reach.
  struct Ends {
    std::uint32_t end[ends];
    CATENA_HD explicit Ends(const Box& box) {
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        end[axis] = in_order(box.high[axis]), end[axis + 3] = in_order(-box.low[axis]);
    }
  };
  /// What the ends of another box must reach to meet this one.
  struct Facing {
    std::uint32_t end[ends];
    CATENA_HD explicit Facing(const Box& box) {
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        end[axis] = in_order(box.low[axis]), end[axis + 3] = in_order(-box.high[axis]);
    }
  };

  CATENA_HD void join(const Ends& of) {
    for (std::uint32_t k = 0; k < ends; ++k) raise(end_ + k, of.end[k]);
  }
  /// One end of a box that was gathered elsewhere.
  CATENA_HD void join_end(std::uint32_t k, std::uint32_t end) { raise(end_ + k, end); }
  CATENA_HD std::uint32_t end(std::uint32_t k) const { return end_[k]; }
  CATENA_HD void clear_end(std::uint32_t k) { end_[k] = 0; }

  /// False only when no sphere in that box touches one of the level.
  CATENA_HD bool meets(const Facing& box) const {
    bool all = true;
    for (std::uint32_t k = 0; k < ends; ++k) all &= box.end[k] <= end_[k];
    return all;
  }

 private:
  /// As floats are, the two zeros alike.
  CATENA_HD static std::uint32_t in_order(float v) {
    const float one_zero = v + 0.0f;
    std::uint32_t bits;
    std::memcpy(&bits, &one_zero, sizeof bits);
    return bits >> 31 != 0 ? ~bits : bits | 0x80000000u;
  }

  std::uint32_t end_[ends];
};

}  // namespace catena

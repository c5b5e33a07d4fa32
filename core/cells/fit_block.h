#pragma once
#include <cstdint>

#include "catena/core/cells/block_capsule.h"

namespace catena {

/// What a block of 32 spheres is: a capsule around it, and whether it and the next one go on in order.
struct BlockShape {
  BlockCapsule capsule;
  bool ordered;  ///< no sphere of it collides with another of it or the next that is more than `window`
                 ///< further on
};

/// Fits a block by a team of threads, each of which takes the same number of consecutive spheres. at(k) is
/// sphere k < 64 of the block and the one after it. In a unit of its own no square of what matters in the
/// block is lost by underflow.
template <class Team, class At>
class BlockFit {
 public:
  CATENA_HD BlockFit(const Team& team, const At& at, std::uint32_t window, bool own_units)
      : team_(team), at_(at), window_(window), own_units_(own_units) {}

  CATENA_HD BlockShape shape() const {
    BlockShape result{about_the_chord(), false};
    BlockCapsule& capsule = result.capsule;
    const Frame frame{capsule.centre, own_units_ ? own_unit(capsule.centre) : 1};
    const Vector32 direction = frame.unit * (centre_of(at_(63)) - centre_of(at_(0))),
                   half = frame.unit * capsule.half;
    const auto part = team_.each([&](std::uint32_t lane) { return part_of(lane, frame, half, direction); });
    const float thickest = team_.greatest([&](std::uint32_t lane) { return part[lane].thickest; });
    result.ordered = in_order(part, direction, thickest);
    const float half_square = dot(half, half);
    const float farthest = team_.greatest([&](std::uint32_t lane) { return part[lane].farthest; });
    float half_length = std::sqrt(half_square);
    capsule.radius = BlockCapsule::with_slack(std::sqrt(farthest) + thickest, half_square);
    if (own_units_) capsule.radius /= frame.unit, half_length /= frame.unit;
    capsule.radius += BlockCapsule::tiny_of(own_units_);
    capsule.reach = half_length + capsule.radius;
    return result;
  }

 private:
  static constexpr std::uint32_t block = 32, share = block / Team::lanes;

  /// The capsule's centre, and the unit of all lengths but its own.
  struct Frame {
    Vector32 centre;
    float unit;  ///< a power of two
    CATENA_HD Vector32 from_centre(const Sphere& s) const { return unit * (centre_of(s) - centre); }
  };
  /// The one in which the block's greatest length is 1 to 2.
  CATENA_HD float own_unit(const Vector32& centre) const {
    const auto reach = team_.each([&](std::uint32_t lane) {
      float greatest = 0;
      for (std::uint32_t k = 0; k < share; ++k) {
        const Sphere s = at_(lane * share + k);
        greatest = std::fmax(greatest, sum_of_sides(centre_of(s) - centre) + s.radius);
      }
      return greatest;
    });
    return unit_of(team_.greatest([&](std::uint32_t lane) { return reach[lane]; }));
  }

  /// What one thread finds, in the frame.
  struct Part {
    float farthest;       ///< square of how far a sphere of the block lies from the axis, but for rounding
    float thickest;       ///< radius in the block
    float next_thickest;  ///< and in the next
    float beyond;         ///< how far a sphere of both lies from the centre at most, along the sides
    float rise;           ///< least, along the direction, from a sphere to that window + 1 further on
    bool falls;           ///< from one sphere to the next, somewhere before window spheres of the next block
  };

  /// About the chord from first to last, moved half way to the middle of the arc.
  CATENA_HD BlockCapsule about_the_chord() const {
    const Vector32 origin = centre_of(at_(0)), chord = centre_of(at_(31)) - origin;
    const Vector32 arc = (centre_of(at_(15)) - origin) + (centre_of(at_(16)) - origin);
    BlockCapsule result{};
    result.half = {0.5f * chord.x, 0.5f * chord.y, 0.5f * chord.z};
    result.centre = plus(plus(origin, 0.5f, result.half), 0.25f, arc);
    return result;
  }

  CATENA_HD Part part_of(std::uint32_t lane, const Frame& frame, const Vector32& half,
                         const Vector32& direction) const {
    const float over = BlockCapsule::inverse_square(dot(half, half));
    Part part{0, 0, 0, 0, 0, false};
    float along[share + 2],
        next_along[share + 2];  // the direction, of own spheres and those of the next block
    for (std::uint32_t k = 0; k < share; ++k) {
      const Sphere own = at_(lane * share + k), next = at_(block + lane * share + k);
      const Vector32 p = frame.from_centre(own), q = frame.from_centre(next);
      // The point of the axis is a guess, and any point of it will do.
      const Vector32 rest = plus(p, -clamped(dot(p, half) * over), half);
      part.farthest = std::fmax(part.farthest, dot(rest, rest));
      part.thickest = std::fmax(part.thickest, own.radius * frame.unit);
      part.next_thickest = std::fmax(part.next_thickest, next.radius * frame.unit);
      part.beyond = std::fmax(part.beyond, std::fmax(sum_of_sides(p), sum_of_sides(q)));
      along[k] = dot(p, direction);
      next_along[k] = dot(q, direction);
    }
    if (window_ == 1)
      climb(lane, frame, direction, along, next_along, part);
    else
      climb_in_window(lane, frame, direction, part);
    return part;
  }

  CATENA_HD float along(std::uint32_t k, const Frame& frame, const Vector32& direction) const {
    return dot(frame.from_centre(at_(k)), direction);
  }

  /// `rise` and `falls`.
  CATENA_HD void climb(std::uint32_t lane, const Frame& frame, const Vector32& direction, float* own,
                       float* next, Part& part) const {
    const bool last = lane == Team::lanes - 1;  // behind the next block there is nothing
    for (std::uint32_t k = share; k < share + 2; ++k) {
      own[k] = along(lane * share + k, frame, direction);
      if (!last) next[k] = along(block + lane * share + k, frame, direction);
    }
    part.rise = own[2] - own[0];
    for (std::uint32_t k = 0; k < share; ++k) {
      part.falls |= own[k + 1] < own[k];
      part.rise = std::fmin(part.rise, own[k + 2] - own[k]);
      if (k + 2 < share || !last) part.rise = std::fmin(part.rise, next[k + 2] - next[k]);
    }
  }
  CATENA_HD void climb_in_window(std::uint32_t lane, const Frame& frame, const Vector32& direction,
                                 Part& part) const {
    const auto at = [&](std::uint32_t k) { return along(k, frame, direction); };
    const std::uint32_t own = lane * share, next = block + own;
    part.rise = at(own + window_ + 1) - at(own);
    for (std::uint32_t k = own; k < own + share; ++k) {
      part.falls |= at(k + 1) < at(k);
      part.rise = std::fmin(part.rise, at(k + window_ + 1) - at(k));
    }
    for (std::uint32_t k = next; k < next + share && k + 1 < 2 * block; ++k) {
      part.falls |= at(k + 1) < at(k);
      if (k + window_ + 1 < 2 * block) part.rise = std::fmin(part.rise, at(k + window_ + 1) - at(k));
    }
  }

  /// True only when the block is ordered: along the direction from the first to the last, of a length at most
  /// `length`, sphere i lies at s_i; where s rises by more than two greatest radii times length from each i
  /// to i + window + 1, and does not fall from i to i + 1, it rises by more than that from i to every sphere
  /// after i + window. The slack is for the rounding of s and of the differences.
  template <class Parts>
  CATENA_HD bool in_order(const Parts& part, const Vector32& direction, float own_thickest) const {
    const float length = std::sqrt(dot(direction, direction)) * (1 + 0x1p-16f);
    const float next_thickest = team_.greatest([&](std::uint32_t lane) { return part[lane].next_thickest; });
    const float thickest = std::fmax(own_thickest, next_thickest);
    const float far = team_.greatest([&](std::uint32_t lane) { return part[lane].beyond; }) + thickest;
    const float step = 2 * thickest * length + (length * far * BlockTree::slack + 0x1p-60f);
    return team_.none([&](std::uint32_t lane) { return part[lane].falls || !(part[lane].rise > step); });
  }

  const Team& team_;
  const At& at_;
  std::uint32_t window_;
  bool own_units_;
};

}  // namespace catena

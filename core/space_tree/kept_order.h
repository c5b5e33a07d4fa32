#pragma once
#include <cstddef>
#include <cstdint>

#include "catena/core/export.h"

namespace catena {

/// Boxes, sixteen a group: low x y z, high x y z, sixteen numbers each; and the radii of what they enclose.
struct BoxGroups {
  const float* first;
  std::uint32_t boxes;
  float least_radius = 0, greatest_radius = 0;

  float field(std::uint32_t box, std::uint32_t f) const {
    constexpr std::uint32_t group = 16, fields = 6;
    return first[(std::size_t{box / group} * fields + f) * group + box % group];
  }
};

/// Whether an order in space that an earlier frame was sorted into still serves: what follows one another in
/// it lies about as near as it did then. It never changes an answer; where it no longer serves, searches take
/// longer. What was kept for long is sorted again whatever it looks like, and where frames have little in
/// common fewer and fewer are tried.
class CATENA_API KeptOrder {
 public:
  /// There is none that could be kept.
  void forget() { entries_ = 0; }
  /// So many were sorted; these boxes are around those that follow one another. O(boxes).
  void sorted(std::uint32_t entries, const BoxGroups& around);
  /// Whether the order of the last frame is worth a try for so many.
  bool may_serve(std::uint32_t entries);
  /// It was tried, and led to these boxes: whether they do. O(boxes).
  bool serves(const BoxGroups& around);
  /// For so many frames it did, since it was sorted.
  std::uint32_t frames() const { return frames_; }

 private:
  /// About in proportion to the pairs of boxes that meet: the sum of what boxes take up, widened by a
  /// middling one; and what all take up together.
  struct Spread {
    double sum = 0, all = 0;
  };
  /// Of boxes that grew by so much on each side since it was sorted, as they are without that.
  Spread spread(const BoxGroups& around, double grown) const;

  std::uint32_t entries_ = 0;
  static constexpr std::uint32_t axes = 3;
  double middling_[axes] = {};                    ///< sides of boxes, when it was sorted
  float least_radius_ = 0, greatest_radius_ = 0;  ///< likewise
  Spread then_;                                   ///< likewise
  std::uint32_t frames_ = 0;                      ///< since
  std::uint32_t wait_ = 0, waits_ = 0;            ///< frames after the next failure, and from now
};

}  // namespace catena

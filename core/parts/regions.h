#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "catena/core/hierarchy/box.h"
#include "catena/core/sphere.h"

namespace catena::parts {

/// Space cut into boxes with about as many spheres in each: halved across its longest side again and again,
/// where that many of a sample of the spheres lie before the cut.
class Regions {
 public:
  /// `count` >= 1 of them, numbered along the cuts. O(s log s) for a sample of s spheres.
  Regions(std::span<const Sphere> spheres, std::uint32_t count);

  /// In which one a centre lies. O(log count).
  std::uint32_t of(const Sphere& sphere) const {
    std::uint32_t at = 0;
    while (!cuts_[at].leaf()) {
      const Cut& cut = cuts_[at];
      const float centre[] = {sphere.x, sphere.y, sphere.z};
      at = centre[cut.axis] < cut.at ? at + 1 : cut.second;
    }
    return cuts_[at].region;
  }

  /// The one in which every centre in this box lies; nothing when there are several. O(log count).
  std::optional<std::uint32_t> around(const Box& box) const {
    std::uint32_t at = 0;
    while (!cuts_[at].leaf()) {
      const Cut& cut = cuts_[at];
      if (box.high[cut.axis] < cut.at)
        ++at;
      else if (box.low[cut.axis] >= cut.at)
        at = cut.second;
      else
        return {};
    }
    return cuts_[at].region;
  }

  /// What is in each region, as a box around it.
  void enclose(std::span<const Box> contents);
  /// visit(region) for each whose contents' box meets this one. After enclose.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit, std::uint32_t at = 0) const {
    if (!around_[at].meets(box)) return;
    if (cuts_[at].leaf()) return visit(cuts_[at].region);
    for_each_meeting(box, visit, at + 1);
    for_each_meeting(box, visit, cuts_[at].second);
  }

 private:
  /// The half before a cut follows it, the other is `second`.
  struct Cut {
    float at = 0;
    int axis = 0;
    std::uint32_t second = 0, region = 0;
    bool leaf() const { return second == 0; }
  };
  void cut(std::span<Sphere> sample, std::uint32_t first, std::uint32_t count);

  std::vector<Cut> cuts_;
  std::vector<Box> around_;  ///< [cut]: what is in its regions
};

}  // namespace catena::parts

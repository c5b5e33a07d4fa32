#include "catena/core/periodic/unwrapped.h"

#include <fmt/format.h>

#include "catena/core/error.h"

namespace catena {
namespace {

using Edges = std::array<double, 3>;

class Unwrapping {
 public:
  Unwrapping(std::span<const Sphere> spheres, const Strands& strands, const PeriodicBox& box)
      : spheres_(spheres), strands_(strands), box_(box), shift_(spheres.size()), strand_of_(spheres.size()) {
    for (std::uint32_t s = 0; s + 1 < strands.first.size(); ++s)
      for (std::uint32_t i = strands.first[s]; i < strands.first[s + 1]; ++i) {
        strand_of_[i] = s;
        if (i > strands.first[s]) shift_[i] = nearest(i - 1, i);
      }
  }

  std::vector<Sphere> spheres(std::span<const Pair> joints) {
    std::vector<std::vector<Pair>> joints_of(strands_.first.size() - 1);
    for (const Pair& joint : joints)
      for (const std::uint32_t end : {joint.i, joint.j}) joints_of[strand_of_[end]].push_back(joint);
    std::vector<bool> placed(joints_of.size(), false);
    for (std::uint32_t s = 0; s < placed.size(); ++s) {
      if (placed[s]) continue;
      placed[s] = true;
      for (std::vector<std::uint32_t> open{s}; !open.empty();) {
        const std::uint32_t from = open.back();
        open.pop_back();
        for (const auto& [i, j] : joints_of[from]) {
          const std::uint32_t here = strand_of_[i] == from ? i : j, there = here == i ? j : i,
                              to = strand_of_[there];
          if (placed[to]) continue;
          move(to, nearest(here, there), shift_[there]);
          placed[to] = true;
          open.push_back(to);
        }
      }
    }
    check(joints);
    std::vector<Sphere> whole;
    whole.reserve(spheres_.size());
    for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
      const Edges by = box_.along(shift_[i]);
      const Sphere& s = spheres_[i];
      whole.push_back({static_cast<float>(s.x + by[0]), static_cast<float>(s.y + by[1]),
                       static_cast<float>(s.z + by[2]), s.radius});
    }
    return whole;
  }

 private:
  /// The shift of j that puts it nearest to i where that is now, edge by edge.
  Edges nearest(std::uint32_t i, std::uint32_t j) const {
    const Sphere &a = spheres_[i], &b = spheres_[j];
    const Edges step = box_.whole_edges({double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z});
    return {shift_[i][0] - step[0], shift_[i][1] - step[1], shift_[i][2] - step[2]};
  }

  void move(std::uint32_t strand, const Edges& wanted, const Edges& now) {
    const Edges by{wanted[0] - now[0], wanted[1] - now[1], wanted[2] - now[2]};
    for (std::uint32_t i = strands_.first[strand]; i < strands_.first[strand + 1]; ++i)
      for (std::size_t edge = 0; edge < 3; ++edge) shift_[i][edge] += by[edge];
  }

  void check(std::span<const Pair> joints) const {
    const auto require = [&](std::uint32_t i, std::uint32_t j) {
      if (nearest(i, j) != shift_[j])
        throw InputError(
            fmt::format("the tube winds around the box between spheres {} and {}, so it has no arc lengths; "
                        "use an index window (--window K)",
                        i, j));
    };
    for (std::size_t s = 0; s < strands_.closed.size(); ++s)
      if (strands_.closed[s] && strands_.first[s] < strands_.first[s + 1])
        require(strands_.first[s + 1] - 1, strands_.first[s]);
    for (const Pair& joint : joints) require(joint.i, joint.j);
  }

  std::span<const Sphere> spheres_;
  const Strands& strands_;
  const PeriodicBox& box_;
  std::vector<Edges> shift_;
  std::vector<std::uint32_t> strand_of_;
};

}  // namespace

std::vector<Sphere> unwrapped(std::span<const Sphere> spheres, const Strands& strands,
                              std::span<const Pair> joints, const PeriodicBox& box) {
  return Unwrapping(spheres, strands, box).spheres(joints);
}

}  // namespace catena

#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace catena::parts {

/// The greatest radius of each sixteen spheres in a row, of each sixteen of these, and so on to one.
class GreatestRadii {
 public:
  explicit GreatestRadii(std::vector<float> radii) {
    levels_.push_back(std::move(radii));
    while (levels_.back().size() > 1) {
      const std::vector<float>& below = levels_.back();
      std::vector<float> level((below.size() + fan - 1) / fan, 0);
      for (std::size_t k = 0; k < below.size(); ++k) level[k / fan] = std::max(level[k / fan], below[k]);
      levels_.push_back(std::move(level));
    }
  }

  /// visit(k) for the spheres from `begin` up to `end`, ascending, but for those of which may(first, last,
  /// greatest) says no: of the places of some in a row, and the greatest of their radii and perhaps others'.
  /// O(log n) for each that is visited.
  template <class May, class Visit>
  void for_each(std::size_t begin, std::size_t end, const May& may, const Visit& visit) const {
    descend(levels_.size() - 1, 0, begin, end, may, visit);
  }

 private:
  static constexpr std::size_t fan = 16, bits = 4;

  template <class May, class Visit>
  void descend(std::size_t level, std::size_t node, std::size_t begin, std::size_t end, const May& may,
               const Visit& visit) const {
    begin = std::max(begin, node << level * bits), end = std::min(end, (node + 1) << level * bits);
    if (begin >= end || !may(begin, end - 1, levels_[level][node])) return;
    if (level == 0) return visit(node);
    const std::size_t first = begin >> (level - 1) * bits, last = (end - 1) >> (level - 1) * bits;
    for (std::size_t child = first; child <= last; ++child) descend(level - 1, child, begin, end, may, visit);
  }

  std::vector<std::vector<float>> levels_;
};

}  // namespace catena::parts

#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/hierarchy/box.h"

namespace catena {

/// Boxes in a row, over sixteen of them a box, and so on to one: a tree without pointers, for what changes
/// often or comes in an order of its own.
class CATENA_API WideBoxTree {
 public:
  static constexpr std::uint32_t fan = 16;

  /// Makes room for so many boxes, all of them empty. Allocates nothing when they are no more than before.
  void clear(std::uint32_t boxes);
  /// Box k, and no box above it: see refresh.
  void set(std::uint32_t k, const Box& box) { set(0, k, box); }
  /// What is above the boxes first, ..., end - 1. O(end - first), and a path to the root.
  void refresh(std::uint32_t first, std::uint32_t end);

  Box box(std::uint32_t k) const;

  /// visit(k) for every box k that meets this one, in their order; an empty box meets none.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (!levels_.empty()) descend(levels_.size() - 1, 0, box, visit);
  }

  /// Whether test(k) holds for a box k that meets this one; those after it are not asked.
  template <class Test>
  bool any_meeting(const Box& box, const Test& test) const {
    return !levels_.empty() && any(levels_.size() - 1, 0, box, test);
  }
  /// Whether any box meets this one.
  bool meets(const Box& box) const {
    return any_meeting(box, [](std::uint32_t) { return true; });
  }

  /// Sixteen boxes, a coordinate after the other; an empty one has low above high.
  struct Group {
    std::array<std::array<float, fan>, 3> low, high;
  };
  /// Groups of boxes, of the boxes around those groups, and so on; the last level is one group.
  std::span<const std::vector<Group>> levels() const { return levels_; }

 private:
  void set(std::size_t level, std::uint32_t k, const Box& box) {
    Group& g = levels_[level][k / fan];
    for (std::uint32_t d = 0; d < 3; ++d) g.low[d][k % fan] = box.low[d], g.high[d][k % fan] = box.high[d];
  }
  static Box around(const Group& group);

  /// Bit k: box k meets this one. Four at a time, as every machine has vectors of that size; left to itself
  /// the compiler takes one after the other, as it must not compare what may not be a number unasked.
  static std::uint32_t meeting(const Group& g, const Box& box) {
    typedef float Floats __attribute__((vector_size(16)));
    typedef std::int32_t Bits __attribute__((vector_size(16)));
    const auto four = [](const float* at) {
      Floats floats;
      std::memcpy(&floats, at, sizeof floats);
      return floats;
    };
    Bits all{};
    for (std::uint32_t k = 0; k < fan; k += 4) {
      Bits meets = four(&g.low[0][k]) <= four(&g.high[0][k]);  // an empty one none, even a box without end
      for (std::uint32_t d = 0; d < 3; ++d)
        meets &= (four(&g.low[d][k]) <= box.high[d]) & (four(&g.high[d][k]) >= box.low[d]);
      all |= meets & Bits{1 << k, 2 << k, 4 << k, 8 << k};
    }
    return static_cast<std::uint32_t>(all[0] | all[1] | all[2] | all[3]);
  }

  template <class Visit>
  void descend(std::size_t level, std::uint32_t group, const Box& box, const Visit& visit) const {
    for (std::uint32_t bits = meeting(levels_[level][group], box); bits != 0; bits &= bits - 1) {
      const std::uint32_t child = group * fan + static_cast<std::uint32_t>(std::countr_zero(bits));
      level == 0 ? visit(child) : descend(level - 1, child, box, visit);
    }
  }

  template <class Test>
  bool any(std::size_t level, std::uint32_t group, const Box& box, const Test& test) const {
    for (std::uint32_t bits = meeting(levels_[level][group], box); bits != 0; bits &= bits - 1) {
      const std::uint32_t child = group * fan + static_cast<std::uint32_t>(std::countr_zero(bits));
      if (level == 0 ? test(child) : any(level - 1, child, box, test)) return true;
    }
    return false;
  }

  std::vector<std::vector<Group>> levels_;
};

}  // namespace catena

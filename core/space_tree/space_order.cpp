#include "catena/core/space_tree/space_order.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <span>
#include <vector>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena {
namespace {

// An entry is a class, a Morton code of so many bits an axis and the number of a box, which takes half of it.
constexpr int bits = 9, classes = 8;

const float* box(const BoxRows& boxes, std::uint64_t entry) {
  return boxes.first + static_cast<std::uint32_t>(entry) * boxes.stride;
}
/// Twice the middle.
Sphere middle(const float* of) { return {of[0] + of[3], of[1] + of[4], of[2] + of[5], 0}; }
/// The greatest side.
float size_of(const float* of) { return std::max({of[3] - of[0], of[4] - of[1], of[5] - of[2]}); }

}  // namespace

struct SpaceOrder::Keys {
  hwy::Sorter sorter;
  std::vector<std::uint64_t> entries;  ///< key, and number of the box

  /// Entries whose low halves are numbers of boxes.
  void sort(const BoxRows& boxes, std::span<std::uint64_t> some, bool by_class, int depth) {
    CentreCorners corners;
    float greatest = 0;
    for (const std::uint64_t entry : some) {
      const float* const of = box(boxes, entry);
      corners.take(middle(of));
      greatest = std::max(greatest, size_of(of));
    }
    const MortonGrid cubes(corners);
    if (cubes.is_point() && !by_class) return;
    for (std::uint64_t& entry : some) {
      const float* const of = box(boxes, entry);
      const std::uint64_t key = cubes.code(middle(of)) >> 3 * (MortonGrid::bits - bits);
      std::uint64_t smaller = 0;
      if (by_class)
        for (float size = 4 * size_of(of); size < greatest && smaller + 1 < classes; size *= 4) ++smaller;
      entry = (smaller << 3 * bits | key) << 32 | static_cast<std::uint32_t>(entry);
    }
    sorter(some.data(), some.size(), hwy::SortAscending());
    if (depth > 0) refine(boxes, some, depth - 1);
  }

  /// A cube with many boxes is cut into cubes of its own.
  void refine(const BoxRows& boxes, std::span<std::uint64_t> some, int depth) {
    constexpr std::size_t many = 64;
    for (std::size_t k = 0, end; k < some.size(); k = end) {
      for (end = k + 1; end < some.size() && some[end] >> 32 == some[k] >> 32;) ++end;
      if (end - k > many) sort(boxes, some.subspan(k, end - k), false, depth);
    }
  }
};

SpaceOrder::SpaceOrder() : keys_(std::make_unique<Keys>()) {}
SpaceOrder::~SpaceOrder() = default;
SpaceOrder::SpaceOrder(SpaceOrder&&) noexcept = default;
SpaceOrder& SpaceOrder::operator=(SpaceOrder&&) noexcept = default;

void SpaceOrder::sort(const BoxRows& boxes) {
  constexpr int deepest = 12;  // 2^(9 * 13) a side, more than binary32 has
  keys_->entries.resize(boxes.size);
  for (std::uint32_t k = 0; k < boxes.size; ++k) keys_->entries[k] = k;
  if (boxes.size > 0) keys_->sort(boxes, keys_->entries, true, deepest);
}

std::uint32_t SpaceOrder::operator[](std::size_t place) const {
  return static_cast<std::uint32_t>(keys_->entries[place]);
}

}  // namespace catena

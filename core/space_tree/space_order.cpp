#include "catena/core/space_tree/space_order.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace catena {
namespace {

constexpr int bits = 9,
              classes = 8;  // cubes a side, as a power of two; a key takes 32 bits, a number as many

/// Bits of a number below 2^10, two zeros between each and the next.
std::uint32_t spread(std::uint32_t v) {
  v = (v | v << 16) & 0x030000FF;
  v = (v | v << 8) & 0x0300F00F;
  v = (v | v << 4) & 0x030C30C3;
  return (v | v << 2) & 0x09249249;
}

const float* box(const BoxRows& boxes, std::uint64_t entry) {
  return boxes.first + static_cast<std::uint32_t>(entry) * boxes.stride;
}
/// Twice the middle.
float middle(const float* of, int d) { return of[d] + of[3 + d]; }
/// The greatest side.
float size_of(const float* of) { return std::max({of[3] - of[0], of[4] - of[1], of[5] - of[2]}); }

}  // namespace

struct SpaceOrder::Keys {
  hwy::Sorter sorter;
  std::vector<std::uint64_t> entries;  ///< key, and number of the box

  /// Entries whose low halves are numbers of boxes.
  void sort(const BoxRows& boxes, std::span<std::uint64_t> some, bool by_class, int depth) {
    float low[3], high[3], greatest = 0;
    for (int d = 0; d < 3; ++d) low[d] = high[d] = middle(box(boxes, some[0]), d);
    for (const std::uint64_t entry : some) {
      const float* const of = box(boxes, entry);
      for (int d = 0; d < 3; ++d)
        low[d] = std::min(low[d], middle(of, d)), high[d] = std::max(high[d], middle(of, d));
      greatest = std::max(greatest, size_of(of));
    }
    const float side = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (side == 0 && !by_class) return;
    const double cubes = side > 0 ? std::ldexp(0.999, bits) / side : 0;
    for (std::uint64_t& entry : some) {
      const float* const of = box(boxes, entry);
      std::uint64_t key = 0, smaller = 0;
      for (int d = 0; d < 3; ++d)
        key |= std::uint64_t{spread(static_cast<std::uint32_t>((middle(of, d) - low[d]) * cubes))} << d;
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

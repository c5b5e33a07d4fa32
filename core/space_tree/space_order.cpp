#include "catena/core/space_tree/space_order.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <vector>

#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/space_tree/key_sort.h"

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

struct SpaceOrder::Sort {
  KeySort sort_keys;
  LargeVector<std::uint64_t> entries;

  /// What the middles and sizes of some boxes are within.
  struct Extents {
    CentreCorners middles;
    float greatest = 0;
    void join(const Extents& other) {
      middles.join(other.middles);
      greatest = std::max(greatest, other.greatest);
    }
  };
  static constexpr std::uint32_t entries_of_a_task = 1 << 13;

  /// Entries whose low halves are numbers of boxes.
  void run(const BoxRows& boxes, std::span<std::uint64_t> some, bool by_class, int depth, const Team& team) {
    const Extents all = extents(boxes, some, team);
    const MortonGrid cubes(all.middles);
    if (cubes.is_point() && !by_class) return;
    team.for_each_range(static_cast<std::uint32_t>(some.size()), entries_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          for (std::uint64_t& entry : some.subspan(begin, end - begin))
                            entry = key(cubes, box(boxes, entry), by_class ? all.greatest : 0) << 32 |
                                    static_cast<std::uint32_t>(entry);
                        });
    sort_keys(some, team);
    if (depth > 0) refine(boxes, some, depth - 1, team);
  }

  static Extents extents(const BoxRows& boxes, std::span<const std::uint64_t> some, const Team& team) {
    std::mutex joining;
    Extents all;
    team.for_each_range(static_cast<std::uint32_t>(some.size()), entries_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          Extents own;
                          for (const std::uint64_t entry : some.subspan(begin, end - begin)) {
                            const float* const of = box(boxes, entry);
                            own.middles.take(middle(of));
                            own.greatest = std::max(own.greatest, size_of(of));
                          }
                          const std::lock_guard lock(joining);
                          all.join(own);
                        });
    return all;
  }

  /// The class of a box among those of this greatest size, and the place of its middle.
  static std::uint64_t key(const MortonGrid& cubes, const float* of, float greatest) {
    std::uint64_t smaller = 0;
    for (float size = 4 * size_of(of); size < greatest && smaller + 1 < classes; size *= 4) ++smaller;
    return smaller << 3 * bits | cubes.code(middle(of)) >> 3 * (MortonGrid::bits - bits);
  }

  /// A cube with many boxes is cut into cubes of its own.
  void refine(const BoxRows& boxes, std::span<std::uint64_t> some, int depth, const Team& team) {
    constexpr std::size_t many = 64;
    std::vector<std::span<std::uint64_t>> cubes;
    for (std::size_t k = 0, end; k < some.size(); k = end) {
      for (end = k + 1; end < some.size() && some[end] >> 32 == some[k] >> 32;) ++end;
      if (end - k <= many) continue;
      const std::span<std::uint64_t> cube = some.subspan(k, end - k);
      if (team.size() == 1 || cube.size() >= KeySort::few)
        run(boxes, cube, false, depth, team);
      else
        cubes.push_back(cube);
    }
    team.for_each_range(static_cast<std::uint32_t>(cubes.size()), 1,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          for (std::uint32_t k = begin; k < end; ++k)
                            run(boxes, cubes[k], false, depth, team);
                        });
  }
};

SpaceOrder::SpaceOrder() : sort_(std::make_unique<Sort>()) {}
SpaceOrder::~SpaceOrder() = default;
SpaceOrder::SpaceOrder(SpaceOrder&&) noexcept = default;
SpaceOrder& SpaceOrder::operator=(SpaceOrder&&) noexcept = default;

void SpaceOrder::sort(const BoxRows& boxes, const Team& team) {
  constexpr int deepest = 12;  // 2^(9 * 13) a side, more than binary32 has
  sort_->entries.resize(boxes.size);
  for (std::uint32_t k = 0; k < boxes.size; ++k) sort_->entries[k] = k;
  if (boxes.size > 0) sort_->run(boxes, sort_->entries, true, deepest, team);
}

std::uint32_t SpaceOrder::operator[](std::size_t place) const {
  return static_cast<std::uint32_t>(sort_->entries[place]);
}

}  // namespace catena

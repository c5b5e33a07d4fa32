#include "catena/core/space_tree/space_order.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <vector>

#include "catena/core/hierarchy/hilbert_curve.h"
#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/space_tree/key_sort.h"

namespace catena {
namespace {

// An entry is a class, a place on the curve of so many bits an axis and the number of a box, which takes half
// of it.
constexpr int bits = 9, classes = 32;
constexpr float step = 8;    // from class to class
constexpr int deepest = 12;  // 2^(9 * 13) a side, more than binary32 has

/// What is sorted: by the number of each the middle, or twice that, and the size.
struct OfBoxes {
  const BoxRows& boxes;
  const float* box(std::uint32_t k) const { return boxes.first + k * boxes.stride; }
  Sphere middle(std::uint32_t k) const {
    const float* const of = box(k);
    return {of[0] + of[3], of[1] + of[4], of[2] + of[5], 0};
  }
  /// The greatest side.
  float size(std::uint32_t k) const {
    const float* const of = box(k);
    return std::max({of[3] - of[0], of[4] - of[1], of[5] - of[2]});
  }
};
struct OfSpheres {
  const Sphere* spheres;
  const Sphere& middle(std::uint32_t k) const { return spheres[k]; }
  float size(std::uint32_t k) const { return spheres[k].radius; }
};

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
  template <class Of>
  void run(const Of& of, std::span<std::uint64_t> some, bool by_class, int depth, const Team& team) {
    const Extents all = extents(of, some, team);
    const MortonGrid cubes(all.middles);
    if (cubes.is_point() && !by_class) return;
    team.for_each_range(static_cast<std::uint32_t>(some.size()), entries_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          for (std::uint64_t& entry : some.subspan(begin, end - begin))
                            entry = key(cubes, of, number(entry), by_class ? all.greatest : 0) << 32 |
                                    number(entry);
                        });
    sort_keys(some, team);
    if (depth > 0) refine(of, some, depth - 1, team);
  }

  static std::uint32_t number(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }

  template <class Of>
  static Extents extents(const Of& of, std::span<const std::uint64_t> some, const Team& team) {
    std::mutex joining;
    Extents all;
    team.for_each_range(static_cast<std::uint32_t>(some.size()), entries_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          Extents own;
                          for (const std::uint64_t entry : some.subspan(begin, end - begin)) {
                            own.middles.take(of.middle(number(entry)));
                            own.greatest = std::max(own.greatest, of.size(number(entry)));
                          }
                          const std::lock_guard lock(joining);
                          all.join(own);
                        });
    return all;
  }

  /// The class of a box among those of this greatest size, and the place of its middle.
  template <class Of>
  static std::uint64_t key(const MortonGrid& cubes, const Of& of, std::uint32_t k, float greatest) {
    std::uint64_t smaller = 0;
    for (float size = step * of.size(k); size < greatest && smaller + 1 < classes; size *= step) ++smaller;
    const auto morton = static_cast<std::uint32_t>(cubes.code(of.middle(k)) >> 3 * (MortonGrid::bits - bits));
    return smaller << 3 * bits | HilbertCurve::place(morton, bits);
  }

  /// A cube with many boxes is cut into cubes of its own.
  template <class Of>
  void refine(const Of& of, std::span<std::uint64_t> some, int depth, const Team& team) {
    constexpr std::size_t many = 64;
    std::vector<std::span<std::uint64_t>> cubes;
    for (std::size_t k = 0, end; k < some.size(); k = end) {
      for (end = k + 1; end < some.size() && some[end] >> 32 == some[k] >> 32;) ++end;
      if (end - k <= many) continue;
      const std::span<std::uint64_t> cube = some.subspan(k, end - k);
      if (team.size() == 1 || cube.size() >= KeySort::few)
        run(of, cube, false, depth, team);
      else
        cubes.push_back(cube);
    }
    team.for_each_range(static_cast<std::uint32_t>(cubes.size()), 1,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          for (std::uint32_t k = begin; k < end; ++k) run(of, cubes[k], false, depth, team);
                        });
  }
};

SpaceOrder::SpaceOrder() : sort_(std::make_unique<Sort>()) {}
SpaceOrder::~SpaceOrder() = default;
SpaceOrder::SpaceOrder(SpaceOrder&&) noexcept = default;
SpaceOrder& SpaceOrder::operator=(SpaceOrder&&) noexcept = default;

void SpaceOrder::sort(const BoxRows& boxes, const Team& team) {
  sort_->entries.resize(boxes.size);
  for (std::uint32_t k = 0; k < boxes.size; ++k) sort_->entries[k] = k;
  if (boxes.size > 0) sort_->run(OfBoxes{boxes}, sort_->entries, true, deepest, team);
}
void SpaceOrder::sort(const ChainView& chain, std::span<const std::uint32_t> only, const Team& team) {
  const std::size_t n = only.empty() ? chain.size : only.size();
  sort_->entries.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) sort_->entries[k] = only.empty() ? k : only[k];
  if (n > 0) sort_->run(OfSpheres{chain.spheres}, sort_->entries, true, deepest, team);
}

std::uint32_t SpaceOrder::operator[](std::size_t place) const {
  return static_cast<std::uint32_t>(sort_->entries[place]);
}

}  // namespace catena

#include "catena/core/space_tree/space_order.h"

#include <algorithm>
#include <mutex>
#include <span>
#include <vector>

#include "catena/core/space_tree/key_sort.h"
#include "catena/core/space_tree/space_keys.h"

namespace catena {
namespace {

constexpr int deepest = 12;  // 2^(9 * 13) a side, more than binary32 has

}  // namespace

struct SpaceOrder::Sort {
  KeySort sort_keys;
  LargeVector<std::uint64_t> entries;

  static constexpr std::uint32_t entries_of_a_task = 1 << 13;

  /// An entry is the number of a box in its lower half, and then its key above that.
  void run(const SpaceRows& rows, std::span<std::uint64_t> some, bool by_class, int depth, const Team& team) {
    const SpaceExtent all = extent(rows, some, team);
    const SpaceGrid grid(all.middles, by_class ? all.greatest : 0);
    if (grid.is_point() && !by_class) return;
    team.for_each_range(static_cast<std::uint32_t>(some.size()), entries_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          make_keys(rows, grid, some.subspan(begin, end - begin));
                        });
    sort_keys(some, team);
    if (depth > 0) refine(rows, some, depth - 1, team);
  }

  static SpaceExtent extent(const SpaceRows& rows, std::span<const std::uint64_t> some, const Team& team) {
    std::mutex joining;
    SpaceExtent all;
    team.for_each_range(static_cast<std::uint32_t>(some.size()), entries_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          const SpaceExtent own = extent_of(rows, some.subspan(begin, end - begin));
                          const std::lock_guard lock(joining);
                          all.join(own);
                        });
    return all;
  }

  /// A cube with many boxes is cut into cubes of its own.
  void refine(const SpaceRows& rows, std::span<std::uint64_t> some, int depth, const Team& team) {
    constexpr std::size_t many = 64, apart = many / 2;
    std::vector<std::span<std::uint64_t>> cubes;
    // Of many in one cube some two that are so far apart in order are found.
    const auto same = [&](std::size_t k, std::size_t j) { return some[k] >> 32 == some[j] >> 32; };
    for (std::size_t k = 0, first = 0; k + apart < some.size();) {
      if (!same(k, k + apart)) {
        k += apart;
        continue;
      }
      std::size_t begin = k, end = k + apart + 1;
      while (begin > first && same(begin - 1, k)) --begin;
      while (end < some.size() && same(end, k)) ++end;
      k = first = end;  // what lies before may have keys of its own by now
      if (end - begin <= many) continue;
      const std::span<std::uint64_t> cube = some.subspan(begin, end - begin);
      if (team.size() == 1 || cube.size() >= KeySort::few)
        run(rows, cube, false, depth, team);
      else
        cubes.push_back(cube);
    }
    team.for_each_range(static_cast<std::uint32_t>(cubes.size()), 1,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          for (std::uint32_t k = begin; k < end; ++k) run(rows, cubes[k], false, depth, team);
                        });
  }
};

SpaceOrder::SpaceOrder() : sort_(std::make_unique<Sort>()) {}
SpaceOrder::~SpaceOrder() = default;
SpaceOrder::SpaceOrder(SpaceOrder&&) noexcept = default;
SpaceOrder& SpaceOrder::operator=(SpaceOrder&&) noexcept = default;

void SpaceOrder::sort(const BoxRows& boxes, const Team& team) {
  sort({boxes.first, boxes.stride, true}, boxes.size, {}, team);
}
void SpaceOrder::sort(const ChainView& chain, std::span<const std::uint32_t> only, const Team& team) {
  static_assert(sizeof(Sphere) == 4 * sizeof(float));
  const std::size_t n = only.empty() ? chain.size : only.size();
  sort({reinterpret_cast<const float*>(chain.spheres), 4, false}, n, only, team);
}

void SpaceOrder::sort(const SpaceRows& rows, std::size_t n, std::span<const std::uint32_t> only,
                      const Team& team) {
  sort_->entries.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) sort_->entries[k] = only.empty() ? k : only[k];
  if (n > 0) sort_->run(rows, sort_->entries, true, deepest, team);
  entries_ = sort_->entries.data();
}

}  // namespace catena

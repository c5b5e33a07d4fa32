// Puts octaves of spheres together as levels of a grid.
#if defined(CATENA_CORE_GRID_FORM_LEVELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_GRID_FORM_LEVELS_INL_H
#undef CATENA_CORE_GRID_FORM_LEVELS_INL_H
#else
#define CATENA_CORE_GRID_FORM_LEVELS_INL_H
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "catena/core/grid/member_buckets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// A level spares its spheres the look into another one's cells, and costs comparisons where small spheres
/// crowd in cells that are wide for them. So a level takes in finer octaves while these stay thin in its
/// cells, as counted.
class LevelForming {
 public:
  LevelForming(const ChainView& chain, std::span<const std::uint32_t> only, const CentreBox& box,
               SphereGrid& grid, const Team& team)
      : chain_(chain), only_(only), box_(box), grid_(grid), team_(team) {}

  void form() {
    grid_.levels.clear();
    grid_.levels.reserve(grid_.octaves.size());
    // Whatever the layouts turn out to be: two buckets a sphere, and what a level has at least.
    grid_.start.reserve(2 * std::size_t{grid_.spheres()} + 1024 * grid_.octaves.size());
    std::size_t starts = 0;
    for (std::size_t o = 0, next; o < grid_.octaves.size(); o = next) {
      next = first_left_out(o);
      const std::uint32_t first = grid_.octaves[o].first, end = grid_.octaves[next - 1].end;
      const bool wide = grid_.wide && next - o == grid_.octaves.size();
      const float greatest = grid_.octaves[o].greatest;
      const BucketMap map = map_buckets(wide ? 2 * greatest : greatest, box_, end - first);
      const std::array<std::uint32_t, 4> half{step_before(map, 1, 0), step_before(map, -1, 1),
                                              step_before(map, 0, 1), step_before(map, 1, 1)};
      grid_.levels.push_back(
          {map, rows_around(map), half, box_, greatest, first, end, wide, starts});
      starts += grid_.levels.back().map.buckets + 1;
    }
    // The order of the chain is the better one.
    if (grid_.levels.size() == 1)
      grid_.members.assign(only_.begin(), only_.end());
    else
      grid_.place.resize(grid_.spheres());
    set_to_zero(starts);
  }

 private:
  static std::array<std::uint32_t, 9> rows_around(const BucketMap& map) {
    std::array<std::uint32_t, 9> rows;
    for (int k = 0; k < 9; ++k) rows[k] = step_before(map, k % 3 - 1, k / 3 - 1);
    return rows;
  }

  /// So few are taken in in any case.
  static constexpr std::uint64_t few = 64;

  /// The first octave that the level which begins with octave o does not take in.
  std::size_t first_left_out(std::size_t o) {
    if (o + 1 == grid_.octaves.size()) return o + 1;
    const BucketMap map =
        map_buckets(grid_.octaves[o].greatest, box_, grid_.spheres() - grid_.octaves[o].first);
    const BucketFinder find(map);
    set_to_zero(map.buckets);
    std::uint64_t met = 0;  // for each one taken in, those in its cell
    for (std::size_t next = o + 1; next < grid_.octaves.size(); ++next) {
      const auto [first, end, greatest] = grid_.octaves[next];
      met += taken_into(find, first, end);
      const std::uint64_t taken_in = end - grid_.octaves[o].end;
      if (taken_in > few && met > SphereGrid::most_in_a_cell * taken_in) return next;
    }
    return grid_.octaves.size();
  }

  /// Counts members first to end - 1 in their cells: for each, those that were there, twice, and one.
  std::uint64_t taken_into(const BucketFinder& find, std::uint32_t first, std::uint32_t end) {
    constexpr std::uint32_t members_of_a_task = 8192;
    const bool alone = team_.size() == 1;
    std::atomic<std::uint64_t> met{0};
    team_.for_each_range(end - first, members_of_a_task, [&](std::uint32_t from, std::uint32_t to) {
      MemberBuckets members;
      std::uint64_t own = 0;
      for (std::uint32_t at = first + from; at < first + to; at += MemberBuckets::most) {
        const std::uint32_t size = std::min(MemberBuckets::most, first + to - at);
        members.take(chain_, grid_, at, size);
        const std::uint32_t* const buckets = members.find(find);
        for (std::uint32_t k = 0; k < size; ++k)
          own += 2 * std::uint64_t{count_one(grid_.start[buckets[k]], alone)} + 1;
      }
      met.fetch_add(own, std::memory_order_relaxed);
    });
    return met;
  }

  void set_to_zero(std::size_t starts) {
    constexpr std::uint32_t numbers_of_a_task = 1 << 16;
    grid_.start.resize(starts);
    team_.for_each_range(static_cast<std::uint32_t>(starts), numbers_of_a_task,
                         [&](std::uint32_t begin, std::uint32_t end) {
                           std::fill(grid_.start.begin() + begin, grid_.start.begin() + end, 0);
                         });
  }

  const ChainView& chain_;
  const std::span<const std::uint32_t> only_;
  const CentreBox& box_;
  SphereGrid& grid_;
  const Team& team_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

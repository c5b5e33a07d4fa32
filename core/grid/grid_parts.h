#pragma once
#include <algorithm>
#include <cstdint>

#include "catena/core/executor/team.h"
#include "catena/core/grid/sphere_grid.h"

namespace catena {

/// Shares a search of a grid out. search(l, begin, end, across) is called for ranges of whole groups of
/// buckets of level l, and, where `across`, of its members, which are to be met with coarser levels.
template <class Search>
void for_each_part(const SphereGrid& grid, const Team& team, const Search& search) {
  constexpr std::uint32_t buckets_of_a_task = 512, members_of_a_task = 512;
  for (std::size_t l = 0; l < grid.levels.size(); ++l) {
    const SphereGrid::Level& level = grid.levels[l];
    team.for_each_range(
        level.map.buckets / 2 + 1, buckets_of_a_task / 2, [&](std::uint32_t begin, std::uint32_t end) {
          search(l, std::min(2 * begin, level.map.buckets), std::min(2 * end, level.map.buckets), false);
        });
    if (l == 0) continue;
    team.for_each_range(level.end - level.first, members_of_a_task,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          search(l, level.first + begin, level.first + end, true);
                        });
  }
}

}  // namespace catena

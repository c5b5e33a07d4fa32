#pragma once
#include <hwy/contrib/sort/vqsort.h>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"

namespace catena {

/// Sorts numbers of 64 bits by a team: shared out by some of them that part the rest about evenly (a sample
/// sort), each share by vectors, or by digits where vectors are narrow and keys many.
class CATENA_API KeySort {
 public:
  /// Fewer are sorted by the caller alone; so few may be sorted by several members of the team at once.
  static constexpr std::size_t few = 1 << 14;

  KeySort();
  ~KeySort();
  KeySort(const KeySort&) = delete;
  KeySort& operator=(const KeySort&) = delete;

  /// Keys that are all different; where upper halves are alike the lower ones rise. O(n log n).
  void operator()(std::span<std::uint64_t> keys, const Team& team);

 private:
  void sort(std::span<std::uint64_t> keys, LargeVector<std::uint64_t>& room, const Team& team);
  /// Where they are then, in `keys` or in `room`.
  std::span<std::uint64_t> sort(std::span<std::uint64_t> keys, std::span<std::uint64_t> room,
                                const Team& team);
  void choose_borders(std::span<const std::uint64_t> keys);
  std::uint16_t share_of(std::uint64_t key) const;
  void add_up(std::uint32_t parts);

  // [member]: they have memory of their own
  std::deque<hwy::Sorter> sorters_;
  std::deque<LargeVector<std::uint64_t>> rooms_;
  std::uint32_t shares_ = 0;
  std::vector<std::uint64_t> borders_;       // and the greatest number, until halves of halves are whole
  LargeVector<std::uint16_t> share_;         // of each key
  std::vector<std::uint32_t> next_, first_;  // [part][share], [share]
  LargeVector<std::uint64_t> copy_;
};

}  // namespace catena

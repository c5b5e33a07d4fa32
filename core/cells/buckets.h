#pragma once
#include <cstdint>

#include "catena/core/cells/cell_table.h"
#include "catena/core/cells/counter.h"
#include "catena/core/host_device.h"

namespace catena {

/// Numbered things sorted by buckets in three steps, none of which looks at the host: plain pointers, valid
/// in one memory space. What is in a bucket lies side by side at *places*; buckets follow one another within
/// a chunk, and chunks lie in any order.
struct Buckets {
  static constexpr std::uint32_t chunk = 1024;  ///< buckets
  static constexpr std::uint32_t crowd = 24;    ///< things in one bucket

  std::uint32_t* count;   ///< by bucket, in whole chunks; all 0 between sorts
  std::uint32_t* start;   ///< by bucket, see starts()
  std::uint32_t* rank;    ///< by thing: how many came into its bucket before
  std::uint32_t* places;  ///< a single number: how many were sorted; 0 before step 2

  /// Rounded up to whole chunks: how many buckets `count` must have room for.
  CATENA_HD static std::uint32_t chunks(const CellTable& table) {
    return (table.buckets + chunk - 1) / chunk;
  }
  /// Where a chunk's part of `start` begins: one more entry than it has buckets, the end of the last.
  CATENA_HD static std::uint32_t starts(std::uint32_t chunk_number) { return chunk_number * (chunk + 1); }
  CATENA_HD static std::uint32_t start_of(std::uint32_t bucket) { return bucket + bucket / chunk; }

  /// Step 1, for each thing.
  CATENA_HD void enter(std::uint32_t bucket, std::uint32_t thing) const {
    rank[thing] = fetch_add(count + bucket, 1);
  }
  // Step 2, for each chunk: counts become starts, and 0 again.
  /// Step 3, for each thing: its place.
  CATENA_HD std::uint32_t place(std::uint32_t bucket, std::uint32_t thing) const {
    return start[start_of(bucket)] + rank[thing];
  }

  /// Places side by side.
  struct Run {
    std::uint32_t first, end;
  };
  /// What is in one bucket, once all have a place.
  CATENA_HD Run in(std::uint32_t bucket) const {
    const std::uint32_t* const at = start + start_of(bucket);
    return {at[0], at[1]};
  }
  /// What is in `cells` > 0 buckets that begin with `from`, as far as it lies side by side: mostly all. Takes
  /// these off.
  CATENA_HD Run take(const CellTable& table, std::uint32_t& from, std::uint32_t& cells) const {
    const std::uint32_t of_chunk = chunk - from % chunk, of_table = table.buckets - from,
                        room = of_chunk < of_table ? of_chunk : of_table, taken = cells < room ? cells : room;
    const std::uint32_t* const at = start + start_of(from);
    cells -= taken;
    from = table.on(from, taken);
    return {at[0], at[taken]};
  }
};

}  // namespace catena

#pragma once

namespace catena::bench {

/// How fast this machine is at this moment: milliseconds of a fixed piece of work that shares no code with
/// what is measured and so changes only with the machine and its load.
struct Load {
  double one_ms = 0;  ///< on one thread
  double all_ms = 0;  ///< the same on as many threads as there are cores, at once, until the last is done
};

/// Measures it, in about a millisecond: distances of all pairs of a few hundred points, and a walk through
/// 128 KiB in an order that no prefetcher knows. The arithmetic and memory of a search, in one number.
Load measured_load();

}  // namespace catena::bench

#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "catena/core/chain/chain.h"
#include "catena/core/pair.h"
#include "catena/core/periodic/periodic_box.h"

namespace catena::bench {

/// How near the decisions of a chain are to changing their mind: the margins |q - t| / t of all pairs that
/// collide, and of those apart with a margin below 1.
struct Margins {
  static constexpr std::size_t decades = 16;
  struct Side {
    std::uint64_t pairs = 0;
    std::array<std::uint64_t, decades> decade{};  ///< margin in [10^-(k+1), 10^-k); the last: and all below
  };
  Side colliding, apart;
  std::uint64_t touching = 0;  ///< of `colliding`, those with margin 0
  std::uint64_t open_in_binary32 =
      0;  ///< pairs that stage 1 of the exact overlap leaves open: margin up to 12u
  std::uint64_t open_in_binary64 = 0;  ///< pairs that stage 2 leaves open: margin up to 10u
  double rounding = 0;                 ///< the most that a coordinate lost when it was read
  /// Pairs with a margin below 1 whose decision such a loss of both centres may have changed.
  std::uint64_t open_by_rounding = 0;
  double least =
      std::numeric_limits<double>::infinity();  ///< smallest margin of all; infinite: there is no pair
  Pair tightest{0, 0};                          ///< a pair that has it
  bool tightest_collides = false;

  void add(const Pair& pair, bool collides, double margin);
  /// By how much a relative change of a squared distance may at most be enlarged before a decision is
  /// another.
  double condition_number() const { return 1 / least; }
};

/// The margins of a chain, by exact arithmetic, whose coordinates were rounded by up to `rounding` before. In
/// a space that a box repeats they are those of the nearest images. Cost of reference::near_pairs, or
/// near_pairs_in_box, which also says what is thrown for a box.
Margins margins_of(const Chain& chain, double rounding = 0, const PeriodicBox* box = nullptr);

}  // namespace catena::bench

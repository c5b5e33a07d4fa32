#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "catena/bench/pivot/pivot_walk.h"
#include "catena/core/scenes/random.h"

namespace catena::bench {

/// What it costs to ask whether a walk stays self-avoiding when k pivots are made together.
struct AtOnce {
  static constexpr auto rebuilt = "Hybrid";  ///< the fastest variant on one core

  std::uint32_t points = 0, pivots = 0;
  std::uint64_t attempts = 0;
  double acceptance = 0;  ///< share of attempts
  double us_per_attempt =
      0;  ///< processor time of the walk's tree: making the moves, the search, undoing them
  double rebuild_us =
      0;              ///< median of the same answer by `rebuilt`: points turned one by one, update, search
  bool agree = true;  ///< the two answers, every time that both were asked

  double times() const { return rebuild_us / us_per_attempt; }
};

/// k = 1, 2, 4, ... and points - 1: random pivots about k different points, made from the first to the last.
/// Each k takes about as many seconds.
std::vector<AtOnce> measure_at_once(PivotWalk& walk, double seconds, Random& random);

/// Of these pivots, about different points in ascending order: the walk after all of them, one point after
/// the other.
std::vector<LatticePoint> turned(const std::vector<LatticePoint>& points, std::span<const Pivot> ascending);

/// {n, pivots, attempts, acceptance, us_per_attempt, rebuild_us, times, agree}
nlohmann::ordered_json to_json(const AtOnce& seen);

}  // namespace catena::bench

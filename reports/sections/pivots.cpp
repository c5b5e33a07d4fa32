#include "catena/bench/pivot/at_once.h"
#include "catena/bench/pivot/end_to_end.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// What an attempt of a pivot costs, beside what others reach, and k of them at once, beside a rebuild.
nlohmann::ordered_json pivots(const Profile& profile) {
  if (profile.judged_steps == 0) return {};
  constexpr std::uint32_t longest = 524'287;
  constexpr double seconds = 0.02;
  Random random(1);
  bench::PivotWalk walk(longest);
  const std::uint64_t moves = 15 * profile.judged_moves;
  auto speed = bench::to_json(bench::measure_end_to_end(walk, moves, random, 4 * longest));
  speed["published_us"] = 3.876643180847168;
  speed["published_by"] =
      "github.com/bencwallace/pivot at a39c81f, bench/times3_fast.json, Apple M1 Pro, from a walk after 20 "
      "attempts a "
      "point";
  auto at_once = nlohmann::ordered_json::array();
  for (const std::uint32_t n : {755u, 16'384u}) {
    bench::PivotWalk shorter(n);
    for (std::uint32_t k = 0; k < 4 * n; ++k) shorter.attempt(bench::random_pivot(n, random));
    for (const bench::AtOnce& seen : bench::measure_at_once(shorter, seconds, random))
      at_once.push_back(bench::to_json(seen));
  }
  return {{"speed", std::move(speed)}, {"at_once", std::move(at_once)}, {"rebuilt", bench::AtOnce::rebuilt}};
}

const RegisterSection registered{"pivots", pivots};

}  // namespace
}  // namespace catena::reports

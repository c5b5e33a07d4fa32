#include "catena/core/grid/bucket_map.h"

#include <algorithm>
#include <cmath>

namespace catena {
namespace {

/// Fewer buckets than this have no room for steps that are all different in every layout.
constexpr std::uint32_t least_buckets = 512;

bool is_prime(std::uint32_t n) {
  if (n % 2 == 0) return n == 2;
  for (std::uint32_t d = 3; std::uint64_t{d} * d <= n; d += 2)
    if (n % d == 0) return false;
  return n > 1;
}

/// Lays the box out row by row, when it has at most `most` cells. A row of 5, 3 rows a layer and 3 layers
/// make all steps different.
bool lay_out(const CentreBox& box, std::uint32_t most, BucketMap& map) {
  std::array<double, 3> low, cells;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::floor(box.low[k] * map.cells_per_unit);
    const double high = std::floor(box.high[k] * map.cells_per_unit);
    if (!(low[k] > -BucketMap::far_cell && high < BucketMap::far_cell)) return false;
    cells[k] = std::max(high - low[k] + 1, k == 0 ? 5.0 : 3.0);
  }
  if (!(cells[0] * cells[1] * cells[2] <= most)) return false;
  map.row = cells[0];
  map.layer = cells[0] * cells[1];
  map.buckets = static_cast<std::uint32_t>(map.layer * cells[2]);
  map.origin = low[0] + map.row * low[1] + map.layer * low[2];
  map.wraps = false;
  return true;
}

}  // namespace

std::uint32_t BucketMap::step(int y, int z) const {
  const double on = y * row + z * layer;
  return static_cast<std::uint32_t>(on - std::floor(on / buckets) * buckets);
}

BucketMap map_buckets(float r, const CentreBox& box, std::uint32_t count) {
  BucketMap map{};
  // Points overlap where they are equal: 2^149 makes all different binary32 numbers different cells.
  map.cells_per_unit = r > 0 ? (1 - BucketMap::cell_slack) / (2.0 * r) : 0x1p149;
  const auto most = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(2 * std::uint64_t{count}, least_buckets, BucketMap::most_buckets - 1000));
  if (lay_out(box, most, map)) return map;
  map.wraps = true;
  map.buckets = most;
  while (!is_prime(map.buckets)) ++map.buckets;
  // 1 / p and 1 / p^2 for p^3 = p + 1: of all lattices in space that of step 1 among these is nearly the most
  // even.
  map.row = std::round(0.75487766624669276 * map.buckets);
  map.layer = std::round(0.56984029099805327 * map.buckets);
  while (!different_steps(map)) ++map.row;
  return map;
}

std::uint32_t step_before(const BucketMap& map, int y, int z) {
  const std::uint32_t step = map.step(y, z);
  return (step == 0 ? map.buckets : step) - 1;
}

bool different_steps(const BucketMap& map) {
  std::array<std::uint64_t, 45> to;
  std::size_t steps = 0;
  for (const int z : {-1, 0, 1})
    for (const int y : {-1, 0, 1})
      for (const std::uint64_t x : {-2, -1, 0, 1, 2})
        to[steps++] = (map.buckets + x + map.step(y, z)) % map.buckets;
  std::ranges::sort(to);
  return std::ranges::adjacent_find(to) == to.end();
}

}  // namespace catena

#include "catena/bench/pivot/at_once.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_set>

#include "catena/bench/pivot/end_to_end.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"

namespace catena::bench {
namespace {

constexpr int compared = 5;

/// About different points, in ascending order.
std::vector<Pivot> random_pivots(std::uint32_t points, std::uint32_t count, Random& random) {
  std::vector<Pivot> pivots;
  std::unordered_set<std::uint32_t> sites;
  while (pivots.size() < count && 2 * std::uint64_t{count} < points) {
    const Pivot pivot = random_pivot(points, random);
    if (sites.insert(pivot.site).second) pivots.push_back(pivot);
  }
  for (std::uint32_t site = 0; pivots.size() < count; ++site) {  // many: those that a throw for each takes
    const std::uint32_t left = points - 1 - site, wanted = count - static_cast<std::uint32_t>(pivots.size());
    const Pivot pivot = random_pivot(points, random);
    if (random.unit() * left < wanted) pivots.push_back({site, pivot.turn});
  }
  std::ranges::sort(pivots, {}, &Pivot::site);
  return pivots;
}

/// The same answer without a tree over the walk.
class Rebuild {
 public:
  explicit Rebuild(const PivotWalk& walk)
      : variant_(StrategyRegistry::instance().make(AtOnce::rebuilt)), chain_(walk.chain(radius)) {
    variant_->prepare(request);
    variant_->build(chain_);
  }

  bool avoids_itself(const std::vector<LatticePoint>& points, std::span<const Pivot> ascending) {
    const Stopwatch watch;
    std::vector<Sphere> spheres;
    spheres.reserve(points.size());
    for (const LatticePoint& p : turned(points, ascending))
      spheres.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), radius});
    chain_ = chain_.moved(std::move(spheres));
    variant_->update(chain_);
    variant_->find(chain_, request, found_);
    us_.push_back(1000 * watch.ms());
    return !found_.found;
  }

  double median_us() {
    std::ranges::sort(us_);
    return us_[us_.size() / 2];
  }

 private:
  static constexpr Request request{.want = Request::Want::any, .frames_follow = true};
  static inline const float radius = std::nextafter(0.5f, 0.0f);

  std::unique_ptr<Variant> variant_;
  Chain chain_;
  Collisions found_;
  std::vector<double> us_;
};

}  // namespace

std::vector<LatticePoint> turned(const std::vector<LatticePoint>& points, std::span<const Pivot> ascending) {
  std::vector<LatticePoint> result;
  result.reserve(points.size());
  LatticeSymmetry turn;
  auto next = ascending.begin();
  for (std::size_t p = 0; p < points.size(); ++p) {
    result.push_back(p == 0 ? points[0] : result[p - 1] + turn(points[p] - points[p - 1]));
    if (next != ascending.end() && next->site == p) turn = (next++)->turn.after(turn);
  }
  return result;
}

std::vector<AtOnce> measure_at_once(PivotWalk& walk, double seconds, Random& random) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t k = 1; k < walk.size() - 1; k *= 2) counts.push_back(k);
  counts.push_back(walk.size() - 1);
  std::vector<AtOnce> all;
  for (const std::uint32_t k : counts) {
    AtOnce seen{.points = walk.size(), .pivots = k};
    Rebuild rebuild(walk);
    for (int c = 0; c < compared; ++c) {
      const auto points = walk.points();
      const std::vector<Pivot> pivots = random_pivots(walk.size(), k, random);
      const bool right = rebuild.avoids_itself(points, pivots);
      seen.agree &= walk.attempt(pivots) == right;
    }
    seen.rebuild_us = rebuild.median_us();
    const Stopwatch whole;
    double us = 0;
    std::uint64_t accepted = 0;
    do {
      std::vector<std::vector<Pivot>> moves;  // made beforehand, so that their making is not measured
      const std::size_t batch = std::max<std::size_t>(1, 4096 / k);
      for (std::size_t m = 0; m < batch; ++m) moves.push_back(random_pivots(walk.size(), k, random));
      const double start = processor_us();
      for (const auto& pivots : moves) accepted += walk.attempt(pivots);
      us += processor_us() - start;
      seen.attempts += batch;
    } while (whole.ms() < 1000 * seconds);
    seen.us_per_attempt = us / static_cast<double>(seen.attempts);
    seen.acceptance = static_cast<double>(accepted) / static_cast<double>(seen.attempts);
    all.push_back(seen);
  }
  return all;
}

nlohmann::ordered_json to_json(const AtOnce& seen) {
  return {{"n", seen.points},
          {"pivots", seen.pivots},
          {"attempts", seen.attempts},
          {"acceptance", seen.acceptance},
          {"us_per_attempt", seen.us_per_attempt},
          {"rebuild_us", seen.rebuild_us},
          {"times", seen.times()},
          {"agree", seen.agree}};
}

}  // namespace catena::bench

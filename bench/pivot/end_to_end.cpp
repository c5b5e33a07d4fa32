#include "catena/bench/pivot/end_to_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "catena/bench/fit/least_squares.h"
#include "catena/core/error.h"

namespace catena::bench {
namespace {

constexpr std::uint64_t runs = 32;

double square(const LatticePoint& p) {
  return static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y + static_cast<double>(p.z) * p.z;
}
double square(const Vec3& v) { return dot(v, v); }

std::uint32_t below(std::uint32_t n, Random& random) { return static_cast<std::uint32_t>(random.unit() * n); }

template <class Walk, class Move>
EndToEnd measure(Walk& walk, std::uint64_t attempts, Random& random, std::optional<std::uint64_t> warm_up,
                 const Move& random_move) {
  EndToEnd seen{.points = walk.size(),
                .warm_up = warm_up.value_or(std::max(attempts / 5, std::uint64_t{20} * walk.size())),
                .attempts = attempts};
  for (std::uint64_t k = 0; k < seen.warm_up; ++k) walk.attempt(random_move(walk.size(), random));
  const auto count = static_cast<double>(attempts);
  double means = 0, squares = 0;
  std::uint64_t accepted = 0;
  const double start = processor_us();
  for (std::uint64_t run = 0; run < runs; ++run) {
    double sum = 0;
    const std::uint64_t of_run = attempts / runs + (run < attempts % runs ? 1 : 0);
    for (std::uint64_t k = 0; k < of_run; ++k) {
      accepted += walk.attempt(random_move(walk.size(), random));
      sum += square(walk.end_to_end());
    }
    means += sum / count, squares += sum * sum / static_cast<double>(of_run) / count;
  }
  seen.us_per_attempt = (processor_us() - start) / count;
  seen.acceptance = static_cast<double>(accepted) / count;
  seen.bytes_per_point = static_cast<double>(walk.bytes()) / walk.size();
  seen.mean_square = means;
  seen.error = std::sqrt(std::max(0.0, squares - means * means) / (runs - 1));
  return seen;
}

}  // namespace

double processor_us() { return static_cast<double>(std::clock()) * 1e6 / CLOCKS_PER_SEC; }

Pivot random_pivot(std::uint32_t points, Random& random) {
  const std::uint32_t site = below(points - 1, random);
  return {site, LatticeSymmetry::number(static_cast<int>(1 + below(LatticeSymmetry::count - 1, random)))};
}

RotationPivot random_rotation_pivot(std::uint32_t spheres, Random& random) {
  const std::uint32_t site = below(spheres - 1, random);
  return {site, random_rotation(random)};
}

EndToEnd measure_end_to_end(PivotWalk& walk, std::uint64_t attempts, Random& random,
                            std::optional<std::uint64_t> warm_up) {
  return measure(walk, attempts, random, warm_up, random_pivot);
}

EndToEnd measure_end_to_end(RotatedChain<>& chain, std::uint64_t attempts, Random& random,
                            std::optional<std::uint64_t> warm_up) {
  return measure(chain, attempts, random, warm_up, random_rotation_pivot);
}

bool Exponent::agrees() const { return std::fabs(nu - published) <= half_width + published_error; }

Exponent fit_exponent(std::span<const EndToEnd> lengths) {
  if (lengths.size() < 4) throw InputError("the exponent needs walks of at least four lengths");
  std::vector<std::vector<double>> terms;
  std::vector<double> logs;
  for (const EndToEnd& seen : lengths) {
    if (!(seen.error > 0))
      throw InputError(fmt::format(
          "walks of {} points always ended as far apart; longer ones, or more moves, tell", seen.points));
    const double steps = seen.points - 1.0,
                 weight = seen.mean_square / seen.error;  // 1 / error of the logarithm
    terms.push_back({weight, weight * 2 * std::log(steps), weight * std::pow(steps, -0.528)});
    logs.push_back(weight * std::log(seen.mean_square));
  }
  const LeastSquares solved = least_squares(terms, logs);
  constexpr double normal = 1.96;
  return {solved.best[1], normal * std::sqrt(solved.variance[1])};
}

nlohmann::ordered_json to_json(const EndToEnd& seen) {
  return {{"n", seen.points},
          {"warm_up", seen.warm_up},
          {"attempts", seen.attempts},
          {"acceptance", seen.acceptance},
          {"mean_square", seen.mean_square},
          {"error", seen.error},
          {"us_per_attempt", seen.us_per_attempt},
          {"bytes_per_point", seen.bytes_per_point}};
}

}  // namespace catena::bench

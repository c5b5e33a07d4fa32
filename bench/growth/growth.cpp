#include "catena/bench/growth/growth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "catena/bench/counts/count_work.h"
#include "catena/bench/fit/least_squares.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

/// The 0.975 quantile of Student's t by degrees of freedom, from 1; beyond, the last is a little wide.
double student_t(std::size_t freedom) {
  constexpr std::array<double, 10> quantile{12.706, 4.303, 3.182, 2.776, 2.571,
                                            2.447,  2.365, 2.306, 2.262, 2.228};
  return quantile[std::min(freedom, quantile.size()) - 1];
}

/// By the first `columns` of: a constant, the power of n, the surface.
Growth::Law fit(const std::vector<Growth::Point>& points, std::size_t columns) {
  if (points.size() < 4) throw std::logic_error("growth: a law needs four points");
  std::vector<std::vector<double>> terms;
  std::vector<double> logs;
  for (const Growth::Point& p : points) {
    if (p.n == 0 || p.node_pairs == 0) throw std::logic_error("growth: nothing was counted");
    terms.push_back({1, std::log(p.n), 1 / std::cbrt(p.n)});
    terms.back().resize(columns);
    logs.push_back(std::log(static_cast<double>(p.node_pairs)));
  }
  const LeastSquares solved = least_squares(terms, logs);
  const std::size_t freedom = points.size() - columns;
  const double rest = solved.rest / static_cast<double>(freedom);
  const double half = student_t(freedom) * std::sqrt(rest * solved.variance[1]);
  return {solved.best[1], solved.best[1] - half, solved.best[1] + half};
}

}  // namespace

Growth::Law Growth::law() const { return fit(points, 3); }
Growth::Law Growth::plain_power() const { return fit(points, 2); }

std::string sized(const std::string& scene, std::uint32_t n) {
  return fmt::format("{}{}n={}", scene, scene.find(':') == std::string::npos ? ":" : ",", n);
}

Growth measure_growth(const std::string& scene, const VariantInfo& variant, std::uint32_t most) {
  Growth growth{scene, variant.name, {}};
  for (int half_decades = 6;; ++half_decades) {
    const auto n = static_cast<std::uint32_t>(std::round(std::pow(10.0, half_decades / 2.0)));
    if (n > most) return growth;
    const Chain chain = open_input(sized(scene, n)).animation->frame(0);
    const auto work = count_work(variant, chain);
    if (!work)
      throw InputError(fmt::format("{} does not count what it compares; see catena list", variant.name));
    if (!growth.points.empty() && chain.size() <= growth.points.back().n)
      throw InputError(fmt::format("{} has {} at every n; leave out what sets another number", scene,
                                   counted(chain.size(), "sphere")));
    growth.points.push_back({chain.size(), work->pair_tests + work->node_visits});
  }
}

nlohmann::ordered_json to_json(const Growth& growth) {
  const Growth::Law law = growth.law(), plain = growth.plain_power();
  auto points = nlohmann::ordered_json::array();
  for (const auto& p : growth.points) points.push_back({{"n", p.n}, {"node_pairs", p.node_pairs}});
  return {{"scene", growth.scene},
          {"variant", growth.variant},
          {"points", points},
          {"exponent", law.exponent},
          {"low", law.low},
          {"high", law.high},
          {"plain", {{"exponent", plain.exponent}, {"low", plain.low}, {"high", plain.high}}},
          {"within_four_thirds", growth.within_four_thirds()}};
}

}  // namespace catena::bench

#include "catena/bench/growth/growth.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "catena/bench/counts/count_work.h"
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

}  // namespace

Growth::Law Growth::law() const {
  if (points.size() < 3) throw std::logic_error("growth: a law needs three points");
  const auto count = static_cast<double>(points.size());
  double mean_x = 0, mean_y = 0;
  for (const Point& p : points) {
    if (p.n == 0 || p.node_pairs == 0) throw std::logic_error("growth: nothing was counted");
    mean_x += std::log(p.n) / count, mean_y += std::log(static_cast<double>(p.node_pairs)) / count;
  }
  double xx = 0, xy = 0, yy = 0;
  for (const Point& p : points) {
    const double x = std::log(p.n) - mean_x, y = std::log(static_cast<double>(p.node_pairs)) - mean_y;
    xx += x * x, xy += x * y, yy += y * y;
  }
  const double slope = xy / xx, rest = std::max(0.0, yy - slope * xy);
  const double half = student_t(points.size() - 2) * std::sqrt(rest / (count - 2) / xx);
  return {slope, slope - half, slope + half};
}

Growth measure_growth(const std::string& scene, const VariantInfo& variant, std::uint32_t most) {
  Growth growth{scene, variant.name, {}};
  const std::string separator = scene.find(':') == std::string::npos ? ":" : ",";
  for (int half_decades = 6;; ++half_decades) {
    const auto n = static_cast<std::uint32_t>(std::round(std::pow(10.0, half_decades / 2.0)));
    if (n > most) return growth;
    const Chain chain = open_input(fmt::format("{}{}n={}", scene, separator, n)).animation->frame(0);
    const auto work = count_work(variant, chain);
    if (!work)
      throw InputError(fmt::format("{} does not count what it compares; see catena list", variant.name));
    growth.points.push_back({chain.size(), work->pair_tests + work->node_visits});
  }
}

nlohmann::ordered_json to_json(const Growth& growth) {
  const Growth::Law law = growth.law();
  auto points = nlohmann::ordered_json::array();
  for (const auto& p : growth.points) points.push_back({{"n", p.n}, {"node_pairs", p.node_pairs}});
  return {{"scene", growth.scene},
          {"variant", growth.variant},
          {"points", points},
          {"exponent", law.exponent},
          {"low", law.low},
          {"high", law.high},
          {"within_four_thirds", growth.within_four_thirds()}};
}

}  // namespace catena::bench

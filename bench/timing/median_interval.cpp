#include "catena/bench/timing/median_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace catena::bench {
namespace {

/// The greatest k with P(Binomial(n, 1/2) < k) <= 2.5 %; 0 when there is none.
std::size_t rank_of_bound(std::size_t n) {
  const double size = static_cast<double>(n);
  double below = 0;
  for (std::size_t k = 0;; ++k) {
    const double chosen = static_cast<double>(k);
    below += std::exp(std::lgamma(size + 1) - std::lgamma(chosen + 1) - std::lgamma(size - chosen + 1) -
                      size * std::numbers::ln2);
    if (below > 0.025) return k;
  }
}

}  // namespace

double MedianInterval::relative_width() const {
  return bounded && median > 0 ? (upper - lower) / median : std::numeric_limits<double>::infinity();
}

MedianInterval median_interval(std::vector<double> samples) {
  if (samples.empty()) throw std::invalid_argument("median_interval: no samples");
  std::ranges::sort(samples);
  const std::size_t n = samples.size(), k = rank_of_bound(n);
  MedianInterval result;
  result.median = n % 2 ? samples[n / 2] : (samples[n / 2 - 1] + samples[n / 2]) / 2;
  result.bounded = k > 0;
  result.lower = samples[k > 0 ? k - 1 : 0];
  result.upper = samples[n - (k > 0 ? k : 1)];
  return result;
}

}  // namespace catena::bench

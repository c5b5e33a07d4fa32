#include "catena/bench/tube/arc_length.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace catena::bench {

ArcLength::ArcLength(const Curve& derivative, std::size_t pieces) : derivative_(derivative), at_{0} {
  const auto count = static_cast<double>(pieces);
  for (std::size_t k = 0; k < pieces; ++k)
    at_.push_back(at_[k] + between(static_cast<double>(k) / count, (static_cast<double>(k) + 1) / count));
}

double ArcLength::parameter(double s) const {
  const auto after = std::ranges::upper_bound(at_, s);
  const auto piece = std::min<std::size_t>(static_cast<std::size_t>(after - at_.begin()), at_.size() - 1) - 1;
  const double width = 1.0 / static_cast<double>(at_.size() - 1), start = static_cast<double>(piece) * width;
  double t = start + width * (s - at_[piece]) / (at_[piece + 1] - at_[piece]);
  for (int k = 0; k < 6; ++k) {
    const double step = (s - at_[piece] - between(start, t)) / length(derivative_(t));
    t += step;
    if (std::abs(step) < 1e-16) break;
  }
  return t;
}

double ArcLength::between(double from, double to) const {
  constexpr std::array nodes{0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array weights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = weights[0] * length(derivative_(middle));
  for (std::size_t k = 1; k < nodes.size(); ++k)
    sum += weights[k] *
           (length(derivative_(middle - half * nodes[k])) + length(derivative_(middle + half * nodes[k])));
  return sum * half;
}

}  // namespace catena::bench

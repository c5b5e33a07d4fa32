#include "catena/core/motion/newton.h"

#include <algorithm>
#include <cmath>

namespace catena::motion {

bool Newton::direction(Coordinates& down) {
  const Eigen::Index size = derivatives_.gradient.size();
  hessian_.resize(size, size);
  hessian_.setFromTriplets(derivatives_.hessian.begin(), derivatives_.hessian.end());
  const auto same = [](const std::vector<int>& known, const int* now, std::size_t count) {
    return known.size() == count && std::equal(known.begin(), known.end(), now);
  };
  const auto columns = static_cast<std::size_t>(size) + 1,
             entries = static_cast<std::size_t>(hessian_.nonZeros());
  if (!same(outer_, hessian_.outerIndexPtr(), columns) || !same(inner_, hessian_.innerIndexPtr(), entries)) {
    cholesky_.analyzePattern(hessian_);
    outer_.assign(hessian_.outerIndexPtr(), hessian_.outerIndexPtr() + columns);
    inner_.assign(hessian_.innerIndexPtr(), hessian_.innerIndexPtr() + entries);
  }
  const double greatest = hessian_.diagonal().cwiseAbs().maxCoeff();
  double shift = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    cholesky_.setShift(shift);
    cholesky_.factorize(hessian_);
    if (cholesky_.info() == Eigen::Success) {
      down = cholesky_.solve(-derivatives_.gradient);
      return down.allFinite();
    }
    shift = shift == 0 ? 1e-10 * greatest : 4 * shift;
  }
  return false;
}

bool Newton::minimise(const Objective& objective, Coordinates& x, double tolerance) {
  if (x.size() == 0) return true;
  const Coordinates begin = x;
  if (full_steps(objective, x, tolerance)) return true;
  x = begin;
  return descend(objective, x, tolerance);
}

bool Newton::full_steps(const Objective& objective, Coordinates& x, double tolerance) {
  constexpr int most_steps = 200;
  Coordinates down;
  for (int step = 0; step < most_steps; ++step) {
    objective.derivatives(x, derivatives_);
    if (!derivatives_.gradient.allFinite() || !direction(down)) return false;
    x += down;
    if (down.lpNorm<Eigen::Infinity>() <= tolerance) return true;
  }
  return false;
}

bool Newton::descend(const Objective& objective, Coordinates& x, double tolerance) {
  constexpr int most_steps = 200;
  Coordinates down, next;
  double value = objective.value(x);
  // Near the minimum a gain drowns in the rounding of values of this size.
  const double size = std::abs(value);
  for (int step = 0; step < most_steps; ++step) {
    if (!std::isfinite(value)) return false;
    objective.derivatives(x, derivatives_);
    if (!direction(down)) return false;
    const double slope = derivatives_.gradient.dot(down), moved = down.lpNorm<Eigen::Infinity>();
    double share = 1;
    for (;; share /= 2) {
      next = x + share * down;
      const double next_value = objective.value(next);
      if (next_value <= value + 1e-4 * share * slope + 1e-13 * size) {
        value = next_value;
        break;
      }
      if (share * moved <= tolerance) return -slope <= 1e-9 * size;
    }
    x.swap(next);
    if (share == 1 && moved <= tolerance) return true;
  }
  return false;
}

}  // namespace catena::motion

#include "catena/core/scenes/turn.h"

#include <cmath>
#include <numbers>

namespace catena {
namespace {

// Taylor series for |x| <= pi/4, where the first term left out is below 2^-56 of the result.
double small_sine(double x) {
  const double s = x * x;
  double sum = 0;
  for (int k = 16; k > 0; k -= 2) sum = -s / (k * (k + 1)) * (1 + sum);
  return x + x * sum;
}

double small_cosine(double x) {
  const double s = x * x;
  double sum = 0;
  for (int k = 17; k > 0; k -= 2) sum = -s / (k * (k + 1)) * (1 + sum);
  return 1 + sum;
}

}  // namespace

CirclePoint circle_point(double turns) {
  const double quarter = std::floor(4 * turns + 0.5);
  const double rest = turns - quarter / 4;  // exact, |rest| <= 1/8
  const double x = 2 * std::numbers::pi * rest;
  const double c = small_cosine(x), s = small_sine(x);
  switch (static_cast<int>(quarter - 4 * std::floor(quarter / 4))) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace catena

#include "catena/core/arithmetic/slow_subnormals.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace catena {
namespace {

/// The least of some times that multiplications of this number by 1, each of the last one's result, take in
/// all.
double seconds(float number) {
  constexpr int rounds = 3, multiplications = 256;
  const volatile float given = number, one = 1;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    float product = given;
    for (int k = 0; k < multiplications; ++k) product *= one;
    const volatile float kept = product;
    static_cast<void>(kept);
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

}  // namespace

bool subnormals_are_slow() {
  constexpr double much = 5;  // times; a normal one waits for the last and for the load of 1
  static const bool slow = seconds(1e-40f) > much * seconds(1.5f);
  return slow;
}

}  // namespace catena

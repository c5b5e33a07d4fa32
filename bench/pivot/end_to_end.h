#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "catena/bench/pivot/pivot_walk.h"
#include "catena/bench/pivot/rotated_chain.h"
#include "catena/core/scenes/random.h"

namespace catena::bench {

/// A pivot about a random point by a random symmetry other than the identity.
Pivot random_pivot(std::uint32_t points, Random& random);
/// A pivot about a random sphere by any rotation.
RotationPivot random_rotation_pivot(std::uint32_t spheres, Random& random);

/// What a run of the pivot algorithm saw of a walk's two ends.
struct EndToEnd {
  std::uint32_t points = 0;
  std::uint64_t warm_up = 0;   ///< attempts before, from a straight walk on
  std::uint64_t attempts = 0;  ///< measured
  double acceptance = 0;       ///< share of attempts
  double mean_square = 0;      ///< of the distance of the ends, in steps
  double error = 0;            ///< standard error of that, from 32 runs of consecutive attempts
  double us_per_attempt = 0;   ///< processor time of this thread, measuring and all
  double bytes_per_point = 0;  ///< of memory that the walk's state takes
};

/// Processor time of the program, in microseconds: another one on the core costs nothing.
double processor_us();

/// Of a walk that is straight or was measured before, and at least 64 attempts. Every attempt counts, whether
/// the walk moved or not. By default a fifth as many come before, or 20 a point where that is more: joints
/// that no pivot has turned yet are straight, and make a long walk longer than it should be.
EndToEnd measure_end_to_end(PivotWalk& walk, std::uint64_t attempts, Random& random,
                            std::optional<std::uint64_t> warm_up = {});
EndToEnd measure_end_to_end(RotatedChain<>& chain, std::uint64_t attempts, Random& random,
                            std::optional<std::uint64_t> warm_up = {});

/// The exponent nu of R^2 = D N^(2 nu) (1 + a N^-0.528), N steps, by weighted least squares in logarithms;
/// 0.528 is the leading correction (Clisby and Duenweg, Phys. Rev. E 94, 052102, 2016).
struct Exponent {
  static constexpr double published = 0.58759700, published_error = 0.00000040;  ///< the same paper
  double nu = 0, half_width = 0;                                                 ///< of the interval of 95 %

  bool agrees() const;  ///< the published value lies in the interval, give or take its own error
};

/// Of at least four lengths. Throws InputError otherwise.
Exponent fit_exponent(std::span<const EndToEnd> lengths);

/// {n, warm_up, attempts, acceptance, mean_square, error, us_per_attempt, bytes_per_point}
nlohmann::ordered_json to_json(const EndToEnd& seen);

}  // namespace catena::bench

#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"

namespace catena::bench {

/// How a search grows on one scene: pairs of nodes whose bounds, or pairs of spheres, that were compared.
/// Counted, not timed, and so the same in every run.
struct Growth {
  struct Point {
    std::uint32_t n;
    std::uint64_t node_pairs;
  };
  std::string scene, variant;
  std::vector<Point> points;

  /// Least squares in logarithms, with the interval of 95 % by Student's t. It says nothing of longer chains.
  struct Law {
    double exponent, low, high;
  };
  /// node_pairs ~ n^exponent (1 + a n^(-1/3)), the second term the share of a body of n spheres that its
  /// surface is. The term was put in after the plain power had been fitted, whose exponent of small compact
  /// bodies lies above 4/3; so both are always shown. Of at least four points, n > 0 and node_pairs > 0;
  /// throws std::logic_error otherwise.
  Law law() const;
  Law plain_power() const;  ///< node_pairs ~ n^exponent

  /// O(n^(4/3)) is not contradicted: the lower end of law()'s interval is not above 4/3.
  bool within_four_thirds() const { return law().low <= 4.0 / 3; }
};

/// The scene, as it may be written on a command line, at that size.
std::string sized(const std::string& scene, std::uint32_t n);

/// The scene at sizes from 1,000 to `most`, half a decade apart. Throws InputError where the variant counts
/// nothing.
Growth measure_growth(const std::string& scene, const VariantInfo& variant, std::uint32_t most);

/// {scene, variant, points: [{n, node_pairs}], exponent, low, high, plain: {exponent, low, high},
/// within_four_thirds}
nlohmann::ordered_json to_json(const Growth& growth);

}  // namespace catena::bench

#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/knots/judge_knot.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"

// Polygons, and what is found of them.
namespace catena::bench {

inline std::unique_ptr<Variant> variant(const std::string& name = "Hybrid") {
  return StrategyRegistry::instance().make(name);
}

inline KnotVerdict judged(const PublishedKnot& published, const Chain& centres, double blur) {
  return judge_knot(*variant(), published, centres, blur);
}

/// The regular polygon of n vertices on a circle of radius 1, moved by `way` along x.
inline Chain ring(std::uint32_t n, float way = 0) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < n; ++k)
    spheres.push_back({static_cast<float>(std::cos(2 * std::numbers::pi * k / n)) + way,
                       static_cast<float>(std::sin(2 * std::numbers::pi * k / n)), 0, 0});
  return Chain(std::move(spheres), Strands::one_closed(n));
}

inline std::uint64_t true_contacts(const Chain& centres, float radius) {
  return reference::find(tube_of(centres, radius)).pair_count;
}

}  // namespace catena::bench

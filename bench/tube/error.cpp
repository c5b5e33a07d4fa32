#include "catena/bench/tube/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catena/core/chain/bending_window.h"
#include "catena/reference/grid.h"

namespace catena::bench {
namespace {

/// Where the spheres lie: n of them at equal steps, on a closed tube all the way round.
double step_of(const Tube& tube, std::uint32_t n) { return tube.length / (tube.closed ? n : n - 1); }

Vec3 at(const Tube& tube, double s) {
  if (tube.closed) return tube.position(s - tube.length * std::floor(s / tube.length));
  return tube.position(std::clamp(s, 0.0, tube.length));
}

struct Between {
  double gap, uncovered;  ///< Hausdorff distance, and volume as length of tube, between two neighbours
};

/// The point of the tube's surface farthest from both spheres lies half way between them, on the side to
/// which the tube bends away from them.
Between between(const Tube& tube, double s, double h) {
  const Vec3 a = at(tube, s), b = at(tube, s + h), middle = at(tube, s + h / 2);
  Vec3 tangent = b - a;
  const double chord = length(tangent);
  tangent = 1 / chord * tangent;
  Vec3 aside = 2.0 * middle - a - b;
  aside = aside - dot(aside, tangent) * tangent;
  const double bulge = length(aside) / 2, half = chord / 2;  // the middle of the chord is `bulge` away
  const double squared = half * half + bulge * bulge + 2 * tube.radius * bulge;  // G^2 - r^2
  const double gap = squared / (std::sqrt(tube.radius * tube.radius + squared) + tube.radius);
  // Two spheres of radius r at distance d add pi (r^2 d - d^3 / 12) to their common volume, up to d = 2r,
  // where they part.
  const double met = std::min(chord, 2 * tube.radius);
  return {gap, h - met + met * met * met / (12 * tube.radius * tube.radius)};
}

/// The deepest overlap of two spheres of the tube's radius near an approach, when the nearest spheres are at
/// s = a, t = b and their multiples of h from there.
template <int reach>
double chain_depth(const Tube& tube, double a, double b, double h) {
  std::array<Vec3, 2 * reach + 1> first, second;
  for (int k = -reach; k <= reach; ++k) {
    first[static_cast<std::size_t>(k + reach)] = at(tube, a + k * h);
    second[static_cast<std::size_t>(k + reach)] = at(tube, b + k * h);
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : first)
    for (const Vec3& q : second) nearest = std::min(nearest, length(p - q));
  return 2 * tube.radius - nearest;
}

/// The least that the nearest spheres of a chain of this spacing can make of an approach, wherever they fall
/// on its two sides.
double worst_depth(const Tube& tube, const Approach& approach, double h) {
  constexpr int phases = 4;
  double worst = std::numeric_limits<double>::infinity();
  for (int i = 0; i < phases; ++i)
    for (int j = 0; j < phases; ++j)
      worst =
          std::min(worst, chain_depth<1>(tube, approach.s + h * i / phases, approach.t + h * j / phases, h));
  return worst;
}

/// The greatest gap of n spheres, of at most 2,000 between neighbours, and the share of the tube outside of
/// them.
Between worst_of(const Tube& tube, std::uint32_t n) {
  const double h = step_of(tube, n);
  const std::uint32_t gaps = tube.closed ? n : n - 1, looked_at = std::min(gaps, 2000u);
  Between worst{0, 0};
  for (std::uint32_t k = 0; k < looked_at; ++k) {
    const auto which = static_cast<double>(std::uint64_t{k} * gaps / looked_at);
    const Between here = between(tube, which * h, h);
    worst.gap = std::max(worst.gap, here.gap);
    worst.uncovered += here.uncovered / h / looked_at;
  }
  return worst;
}

}  // namespace

std::uint32_t spheres_for(const Tube& tube, double tolerance) {
  const auto enough = [&](std::uint32_t n) { return worst_of(tube, n).gap <= tolerance * tube.radius; };
  std::uint32_t few = 7, many = 8;
  while (!enough(many)) few = many, many *= 2;
  while (many - few > 1) {
    const std::uint32_t middle = few + (many - few) / 2;
    (enough(middle) ? many : few) = middle;
  }
  return many;
}

TubeError tube_error(const Tube& tube, const std::vector<Approach>& all, std::uint32_t n) {
  TubeError error;
  error.n = n;
  const double h = error.spacing = step_of(tube, n);
  const Between worst = worst_of(tube, n);
  error.gap = worst.gap;
  error.volume_deficit =
      std::max(worst.uncovered, 0.0);  // the finest is below what rounding makes of h - chord
  error.covering_radius = tube.radius + error.gap;

  const Approach* deepest = nullptr;
  for (const Approach& approach : all) {
    const bool touches = approach.depth(tube.radius) >= 0;
    const double depth =
        chain_depth<6>(tube, h * std::round(approach.s / h), h * std::round(approach.t / h), h);
    const bool found = depth >= 0, found_by_covering = depth + 2 * error.gap >= 0;
    error.contacts += touches;
    error.missed += touches && !found;
    error.invented += !touches && found_by_covering;
    error.missed_by_covering += touches && !found_by_covering;
    if (touches && (deepest == nullptr || approach.distance < deepest->distance)) deepest = &approach;
  }
  if (deepest != nullptr) {
    error.depth_error = deepest->depth(tube.radius) - worst_depth(tube, *deepest, h);
    error.covering_depth_error = 2 * error.gap;  // reached when two spheres lie at the nearest places
  }
  return error;
}

Chain inscribed_chain(const Tube& tube, std::uint32_t n, double offset) {
  const double h = step_of(tube, n);
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 p = at(tube, i * h) + Vec3{offset, offset, offset};
    spheres.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                       static_cast<float>(tube.radius)});
  }
  return Chain(std::move(spheres), tube.closed ? Strands::one_closed(n) : Strands{},
               Exclusion::arc(bending_window));
}

double stored_error(const Tube& tube, std::uint32_t n, double offset) {
  const double h = step_of(tube, n);
  double worst = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 p = at(tube, i * h) + Vec3{offset, offset, offset};
    worst = std::max(
        worst, length(p - Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}));
  }
  return worst;
}

StorageError storage_error(const Tube& tube, std::uint32_t n, double offset) {
  const double h = step_of(tube, n), reach = 2 * tube.radius;
  std::vector<Vec3> real;
  std::vector<Sphere> stored;
  for (std::uint32_t i = 0; i < n; ++i) {
    real.push_back(at(tube, i * h) + Vec3{offset, offset, offset});
    const Vec3& p = real.back();
    stored.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                      static_cast<float>(tube.radius)});
  }
  StorageError error;
  error.least_margin = std::numeric_limits<double>::infinity();
  error.decades.assign(10, 0);
  const Chain chain(std::move(stored), tube.closed ? Strands::one_closed(n) : Strands{});
  reference::near_pairs(chain, [&](const Pair& pair, bool collides, double margin) {
    if (tube.neighbours(pair.i * h, pair.j * h)) return;
    const Vec3 apart = real[pair.i] - real[pair.j];
    error.pairs += collides;
    error.flips += collides != (dot(apart, apart) <= reach * reach);
    error.least_margin = std::min(error.least_margin, margin);
    const double decade = margin > 0 ? std::floor(-std::log10(margin)) : 9;
    ++error.decades[static_cast<std::size_t>(std::clamp(decade, 0.0, 9.0))];
  });
  return error;
}

}  // namespace catena::bench

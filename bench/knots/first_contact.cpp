#include "catena/bench/knots/first_contact.h"

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "catena/core/scenes/step_between.h"
#include "catena/reference/exact_gap.h"

namespace catena::bench {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<Sphere> of_radius(const Chain& centres, float radius) {
  std::vector<Sphere> spheres(centres.spheres().begin(), centres.spheres().end());
  for (Sphere& s : spheres) s.radius = radius;
  return spheres;
}

Collisions searched(Variant& variant, const Chain& chain, const Request& request) {
  Collisions found;
  variant.prepare(request);
  variant.build(chain);
  variant.find(chain, request, found);
  return found;
}

/// The least radius at which two spheres about these centres touch, from an estimate that is nearly it.
float least_radius(Sphere a, Sphere b, float estimate) {
  const auto touch = [&](float radius) {
    a.radius = b.radius = radius;
    return reference::overlap(a, b);
  };
  float radius = estimate;
  while (!touch(radius)) radius = std::nextafter(radius, infinity);
  while (radius > 0 && touch(std::nextafter(radius, 0.0f))) radius = std::nextafter(radius, 0.0f);
  return radius;
}

}  // namespace

float FirstContact::apart() const { return std::nextafter(radius, 0.0f); }

Chain tube_of(const Chain& centres, float radius) {
  return Chain(of_radius(centres, radius), centres.strands(), Exclusion::arc(bending_window));
}

std::optional<FirstContact> first_contact(Variant& variant, const Chain& centres, float greatest) {
  const Chain all(of_radius(centres, greatest), centres.strands(), Exclusion::index(1));
  const Chain tube = tube_of(centres, greatest);
  const ExclusionView rule = tube.view().exclusion;
  std::optional<FirstContact> first;
  for (const Pair& pair : searched(variant, all, {}).pairs) {
    const Sphere &a = all[pair.i], &b = all[pair.j];
    const auto estimate = static_cast<float>(length(step_between(a, b)) / 2);
    if (first && estimate > std::nextafter(first->radius, infinity)) continue;
    const float radius = least_radius(a, b, estimate);
    // Neighbours when they touch stay neighbours when they grow.
    if ((!first ||
         std::tie(radius, pair.i, pair.j) < std::tie(first->radius, first->pair.i, first->pair.j)) &&
        !rule.neighbours(pair.i, pair.j, radius, radius))
      first = {radius, pair};
  }
  return first;
}

std::uint64_t contacts_at(Variant& variant, const Chain& centres, float radius) {
  return searched(variant, tube_of(centres, radius), {.want = Request::Want::counts}).pair_count;
}

}  // namespace catena::bench

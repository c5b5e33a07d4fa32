#include "catena/core/chain/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catena/core/chain/make_topology.h"
#include "catena/core/counted.h"
#include "catena/core/default_floats.h"
#include "catena/core/error.h"
#include "catena/core/never_destroyed.h"
#include "catena/core/sphere_vector.h"

namespace catena {
namespace {

constexpr std::size_t max_spheres = (std::size_t{1} << 31) - 1;

using namespace sphere_vector;

/// Of some spheres, along each axis and of their radii; the greatest magnitude of all, by its bits.
struct Range {
  Four low, high;
  Bits most{};

  explicit Range(const Sphere& s) : low(four(s)), high(low) { take(s); }
  void take(const Sphere& s) {
    const Four sphere = four(s);
    const Bits bits = magnitude_bits(sphere);
    low = sphere < low ? sphere : low;
    high = sphere > high ? sphere : high;
    most = bits > most ? bits : most;
  }
  void join(const Range& other) {
    low = other.low < low ? other.low : low;
    high = other.high > high ? other.high : high;
    most = other.most > most ? other.most : most;
  }
  /// Whether all are spheres: finite, and no radius negative.
  bool are_spheres() const {
    const Bits wrong = most >= not_finite;
    return (wrong[0] | wrong[1] | wrong[2] | wrong[3]) == 0 && !(low[3] < 0);
  }
  Extent extent() const {
    return {low[3], high[3],
            (double{high[0]} - low[0]) + (double{high[1]} - low[1]) + (double{high[2]} - low[2]),
            std::max({-low[0], -low[1], -low[2], high[0], high[1], high[2], 0.0f})};
  }
};

/// Of at least one. Two at a time, as each minimum waits for the one before.
Range range_of(const std::vector<Sphere>& spheres) {
  Range range(spheres.front()), other(spheres.back());
  for (std::size_t k = 1; k + 1 < spheres.size(); k += 2) range.take(spheres[k]), other.take(spheres[k + 1]);
  range.join(other);
  return range;
}

void require_sphere(const Sphere& s, std::size_t i) {
  if (!std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) || !std::isfinite(s.radius))
    throw InputError(
        fmt::format("sphere {} is not finite: x={} y={} z={} radius={}", i, s.x, s.y, s.z, s.radius));
  if (s.radius < 0) throw InputError(fmt::format("sphere {} has the negative radius {}", i, s.radius));
}

}  // namespace

/// They are made to be assigned to, and share one topology.
Chain::Chain() {
  static const auto& of_none = never_destroyed(make_topology({}, {}, {}));
  topology_ = of_none;
}

Chain::Chain(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion)
    : spheres_(std::move(spheres)) {
  const DefaultFloats floats;
  check_spheres();
  topology_ = make_topology(spheres_, std::move(strands), std::move(exclusion));
  tell_reach();
}

Chain::Chain(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion, ArcLengths arcs)
    : spheres_(std::move(spheres)) {
  const DefaultFloats floats;
  check_spheres();
  topology_ = make_topology(spheres_, std::move(strands), std::move(exclusion), &arcs);
  tell_reach();
}

Chain::Chain(std::vector<Sphere> spheres, std::shared_ptr<const Topology> topology)
    : spheres_(std::move(spheres)), topology_(std::move(topology)) {
  const DefaultFloats floats;
  check_spheres();
}

Chain Chain::moved(std::vector<Sphere> spheres) const {
  if (spheres.size() != spheres_.size())
    throw InputError(fmt::format("a moved chain must keep its {}, got {}", counted(spheres_.size(), "sphere"),
                                 spheres.size()));
  Chain chain(std::move(spheres), topology_);
  if (chain.extent_.least_radius == extent_.least_radius &&
      chain.extent_.greatest_radius == extent_.greatest_radius)
    chain.reach_ = reach_;
  else
    chain.tell_reach();
  return chain;
}

ChainView Chain::view() const noexcept {
  const Topology& t = *topology_;
  const bool one_open = strand_count() == 1 && t.strands.closed[0] == 0,
             window_alone =
                 one_open && t.exclusion.rule == Exclusion::Rule::index_window && t.extra_row.empty();
  return {spheres_.data(),
          size(),
          strand_count(),
          static_cast<std::uint32_t>(t.extra.size()),
          {t.exclusion.rule, one_open, window_alone, t.exclusion.window, t.exclusion.factor, nullptr, 0, 0,
           t.strand_of.data(), t.strands.first.data(), t.strands.closed.data(), t.arc.data(),
           t.loop_length.data(), t.extra_row.empty() ? nullptr : t.extra_row.data(), t.extra.data()},
          extent_,
          t.number,
          reach_};
}

void Chain::tell_reach() {
  reach_ = neighbour_reach(*topology_, extent_.least_radius, extent_.greatest_radius);
}

void Chain::check_spheres() {
  if (spheres_.size() > max_spheres)
    throw InputError(fmt::format("a chain holds at most {} spheres, got {}", max_spheres, spheres_.size()));
  if (spheres_.empty()) return;
  const Range range = range_of(spheres_);
  if (!range.are_spheres())
    for (std::size_t i = 0; i < spheres_.size(); ++i) require_sphere(spheres_[i], i);
  extent_ = range.extent();
}

}  // namespace catena

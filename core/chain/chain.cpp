#include "catena/core/chain/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catena/core/chain/make_topology.h"
#include "catena/core/default_floats.h"
#include "catena/core/error.h"

namespace catena {
namespace {

constexpr std::size_t max_spheres = (std::size_t{1} << 31) - 1;

Extent extent_of(const std::vector<Sphere>& spheres) {
  if (spheres.empty()) return {};
  Sphere low = spheres[0], high = spheres[0];
  for (const Sphere& s : spheres) {
    low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z), std::min(low.radius, s.radius)};
    high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z),
            std::max(high.radius, s.radius)};
  }
  return {low.radius, high.radius,
          (double{high.x} - low.x) + (double{high.y} - low.y) + (double{high.z} - low.z),
          std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z, 0.0f})};
}

}  // namespace

Chain::Chain(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion)
    : spheres_(std::move(spheres)) {
  const DefaultFloats floats;
  check_spheres();
  topology_ = make_topology(spheres_, std::move(strands), std::move(exclusion));
}

Chain::Chain(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion, ArcLengths arcs)
    : spheres_(std::move(spheres)) {
  const DefaultFloats floats;
  check_spheres();
  topology_ = make_topology(spheres_, std::move(strands), std::move(exclusion), &arcs);
}

Chain::Chain(std::vector<Sphere> spheres, std::shared_ptr<const Topology> topology)
    : spheres_(std::move(spheres)), topology_(std::move(topology)) {
  const DefaultFloats floats;
  check_spheres();
}

Chain Chain::moved(std::vector<Sphere> spheres) const {
  if (spheres.size() != spheres_.size())
    throw InputError(
        fmt::format("a moved chain must keep its {} spheres, got {}", spheres_.size(), spheres.size()));
  return Chain(std::move(spheres), topology_);
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
          t.number};
}

void Chain::check_spheres() {
  if (spheres_.size() > max_spheres)
    throw InputError(fmt::format("a chain holds at most {} spheres, got {}", max_spheres, spheres_.size()));
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Sphere& s = spheres_[i];
    if (!std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) || !std::isfinite(s.radius))
      throw InputError(
          fmt::format("sphere {} is not finite: x={} y={} z={} radius={}", i, s.x, s.y, s.z, s.radius));
    if (s.radius < 0) throw InputError(fmt::format("sphere {} has the negative radius {}", i, s.radius));
  }
  extent_ = extent_of(spheres_);
}

}  // namespace catena

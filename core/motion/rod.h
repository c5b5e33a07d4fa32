#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/motion/derivatives.h"

namespace catena::motion {

/// Elastic properties of a rod in any consistent units, such as sphere radii and the force that pulls it.
struct RodMaterial {
  double stretching = 1e4;  ///< tension at a strain of 1 (E A)
  double bending = 2;       ///< bending moment at a curvature of 1 (E I)
  double spacing = 1;       ///< rest length of every edge
};

/// Rods as discrete elastic rods, straight at rest: one or more runs of nodes, a straight edge between each
/// two. Source: Bergou, Wardetzky, Robinson, Audoly and Grinspun, Discrete Elastic Rods, 2008. Twist is left
/// out because it cannot arise: the section is isotropic and the ends are free to turn, so the frame of least
/// energy is the twist-free one.
class Rods {
 public:
  /// Rod k has the nodes first[k] .. first[k + 1] - 1; the last entry is the number of nodes.
  Rods(const RodMaterial& material, std::vector<std::uint32_t> first)
      : material_(material), first_(std::move(first)) {}

  /// Half stretching * strain^2 * spacing, over the edges. O(n), as all here.
  double stretching_energy(const Coordinates& x) const;
  /// Half bending * curvature^2 * spacing, over the inner nodes, with the curvature 2 tan(angle / 2) /
  /// spacing: it grows without bound before an edge folds onto the last.
  double bending_energy(const Coordinates& x) const;
  /// Greatest |strain| of an edge; 0 without edges.
  double greatest_strain(const Coordinates& x) const;
  /// Adds gradient and full Hessian of both energies.
  void add_derivatives(const Coordinates& x, Derivatives& out) const;

  const RodMaterial& material() const { return material_; }
  const std::vector<std::uint32_t>& first() const { return first_; }

 private:
  template <class Visit>
  void each_edge(const Visit& visit) const;  ///< visit(i): the edge from node i to i + 1
  template <class Visit>
  void each_bend(const Visit& visit) const;  ///< visit(i): between the edges i - 1, i and i, i + 1

  RodMaterial material_;
  std::vector<std::uint32_t> first_;
};

}  // namespace catena::motion

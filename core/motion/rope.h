#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/variant.h"
#include "catena/core/vec3.h"

namespace catena::motion {

/// Ropes in units in which the radius, the mass of a rope of length 1 and the force that pulls are about 1.
struct RopeSettings {
  double stretching = 1e4;  ///< tension at a strain of 1: 1e2 is a rubber band, 1e9 hardly gives at all
  double bending = 2;       ///< bending moment at a curvature of 1
  double contact = 100;     ///< repulsion of two crossing ropes of length 1 each, at a depth of 1
  double spacing = 1;       ///< rest length between two spheres; each has this mass, an end half of it
  double pull = 1;          ///< force on both ends of every rope, outward along x
  double drag = 0.05;       ///< force on a length of 1 at a speed of 1
};

/// The balance of energy at one moment. `kinetic + stretching + bending + contact` began as `initial`, gained
/// the `work` of the ends and lost `dissipated` to the drag; what then is missing or too much is the error of
/// the motion: of the integrator, and of contacts that were found too late, not at all, or wrongly.
struct EnergyBalance {
  double initial = 0, kinetic = 0, stretching = 0, bending = 0, contact = 0, work = 0, dissipated = 0;
  double error() const { return kinetic + stretching + bending + contact - initial - work + dissipated; }
};

/// Who are neighbours on a rope: spheres at most pi radii apart along it, which is as near as a rope of that
/// thickness can bend back onto itself.
Exclusion rope_neighbours(double spacing);

/// Ropes in motion: discrete elastic rods in binary64, integrated by BDF2 (implicit, second order, L-stable;
/// the first step is backward Euler), each step solved by Newton's method to rounding. Contacts are those
/// that a variant finds on the stored chain, binary32, at the beginning of the step, so the motion is what
/// that variant makes of it. The same settings and pairs give the same bits on machines of one
/// kind (Eigen's sums follow the width of the vector unit).
class RopeMotion {
 public:
  struct Start {
    std::vector<Vec3> position, velocity;  ///< by sphere
    std::vector<std::uint32_t> first;      ///< strands + 1 offsets
  };
  /// From working units to the stored sphere, as SceneSetup::place.
  using Place = std::function<Sphere(const Vec3&)>;

  /// Finds the contacts of the start. Throws what `place` and the variant throw.
  RopeMotion(const RopeSettings& settings, const Start& start, Place place, std::unique_ptr<Variant> variant);
  ~RopeMotion();
  RopeMotion(RopeMotion&&) noexcept;
  RopeMotion& operator=(RopeMotion&&) noexcept;

  /// Moves on by `dt` > 0, which should not change from step to step (a change restarts with backward Euler),
  /// then finds the contacts anew. False when the step has no solution or a coordinate is too large to be
  /// stored; the ropes then stay where they were. O(n + contacts), and a find of the variant. What it throws,
  /// of the variant or for want of memory, leaves the motion of no further use: it may be within a step.
  bool step(double dt);

  /// What the variant was given: spheres of one radius, neighbours as rope_neighbours says.
  const Chain& chain() const;
  std::span<const Pair> contacts() const;  ///< what it found there, sorted
  std::vector<Vec3> positions() const;
  std::vector<Vec3> velocities() const;
  EnergyBalance energy() const;
  double greatest_strain() const;  ///< |strain| of an edge
  /// The deepest that two spheres that are no neighbours overlap, found or not, in radii: 2 when their
  /// centres meet. 0 when none do. O(n^2).
  double deepest_penetration() const;
  double find_ms() const;  ///< spent in the variant since the start: update and find

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace catena::motion

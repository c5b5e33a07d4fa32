#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/arithmetic/mul_add.h"
#include "catena/core/hierarchy/radius_range.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// Exact pairs, conservative trees. Overlap is decided in exact real arithmetic on the stored floats in three
/// stages; a parent encloses its children as a theorem; a node is skipped only when it is separate for
/// certain. u is half an ulp of 1: 2^-24 in binary32, 2^-53 in binary64. properties/proofs/ has the proofs of
/// the constants.
struct Robust {
  static constexpr const char* name = "robust";
  static constexpr bool exact = true;  ///< whether pairs are those of exact real arithmetic
  using Bound = Sphere;

  CATENA_HD static Bound bound(const Sphere& s) { return s; }

  /// True only when the spheres are separate for certain by stage 1; cheap, and free of calls.
  CATENA_HD static bool separate(const Sphere& a, const Sphere& b) {
    return Binary32::fused_square(a, b) > Binary32::greatest_square(a, b) + underflow_floor;
  }

  /// Negative unless they are separate for certain.
  CATENA_HD static float excess(const Sphere& a, const Sphere& b) { return separate(a, b) ? 1.0f : -1.0f; }

  /// True when the spheres overlap or touch. Exact for all finite Spheres.
  CATENA_HD static bool overlap(const Sphere& a, const Sphere& b) {
    const Binary32 n(a, b);
    if (n.separate()) return false;
    if (n.in_range() && n.q * binary32_slack < n.t) return true;
    return overlap_undecided(a, b);
  }
  /// overlap(), but false where `excluded`.
  CATENA_HD static bool overlap_unless(bool excluded, const Sphere& a, const Sphere& b) {
    return !excluded && overlap(a, b);
  }

  /// False only when the spheres are separate for certain. A node may have an infinite radius.
  CATENA_HD static bool may_overlap(const Sphere& query, const Sphere& node) {
    const Binary32 n(query, node);
    if (n.separate()) return false;
    return n.in_range() || decide_in_binary64(query, node) != Decision::separate;
  }

  /// The same tests for a chain in range, whose stage 1 needs neither floor nor range check: one product more
  /// than the paper's at a node.
  struct InRange {
    using Bound = Sphere;
    CATENA_HD static Bound bound(const Sphere& s) { return s; }
    CATENA_HD static bool separate(const Sphere& a, const Sphere& b) {
      return Binary32::fused_square(a, b) > Binary32::greatest_square(a, b);
    }
    /// q less the greatest square, which the sum begins with: three operations, and a sign
    /// (properties/proofs/excess_binary32.g).
    CATENA_HD static float excess(const Sphere& a, const Sphere& b) {
      const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      return mul_add(dz, dz, mul_add(dy, dy, mul_add(dx, dx, -Binary32::greatest_square(a, b))));
    }
    CATENA_HD static bool overlap(const Sphere& a, const Sphere& b) {
      const Binary32 n(a, b);
      if (n.q > n.t * binary32_slack) return false;
      return n.q * binary32_slack < n.t || overlap_undecided(a, b);
    }
    /// overlap(), but false where `excluded`. For those that are mostly near: of one branch, which then
    /// nearly always goes the same way.
    CATENA_HD static bool overlap_unless(bool excluded, const Sphere& a, const Sphere& b) {
      const Binary32 n(a, b);
      const bool apart = n.q > n.t * binary32_slack, sure = n.q * binary32_slack < n.t;
      return (apart | sure | excluded) ? sure & !excluded : overlap_undecided(a, b);
    }
    CATENA_HD static bool may_overlap(const Sphere& query, const Sphere& node) {
      const Binary32 n(query, node);
      return !(n.q > n.t * binary32_slack);
    }
  };

  /// True when InRange may compare any sphere of the chain with any bound of a tree over it: every sum of two
  /// radii has its square in stage 1's range.
  static bool in_range(const RadiusRange& radii) {
    return radii.least > safe_radius_min && radii.reach < safe_radius_max;
  }

  /// A sphere that encloses both, in exact arithmetic; bit-identical on host and device. The radius is
  /// infinite where the sum of the radii overflows.
  CATENA_HD static Sphere parent(const Sphere& a, const Sphere& b) {
    using std::fabs;
    using std::sqrt;
    const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    const float q = dx * dx + dy * dy + dz * dz;
    if (!(q > safe_square_min && q < safe_square_max)) return parent_in_binary64(a, b);
    const float d = sqrt(q), e = b.radius - a.radius;
    // The negation takes two infinite radii, too.
    if (!(d * contained_slack > fabs(e))) return e > 0 ? b : a;

    const float t = 0.5f + 0.5f * e / d;  // the part of the way to b; outside [0, 1] by rounding at most
    const float px = t * dx, py = t * dy, pz = t * dz;
    const float x = a.x + px, y = a.y + py, z = a.z + pz;
    // How far rounding moved the centre from a + p: measured, not bounded, so that a far origin costs only
    // what it really costs.
    const float drift = (fabs(px - (x - a.x)) + fabs(py - (y - a.y))) + fabs(pz - (z - a.z));
    const float half_span = 0.5f * (d + (a.radius + b.radius));
    return {x, y, z, (half_span + drift) * parent_slack};
  }

  /// Of stages 1 and 2, here and where they are asked for many spheres at a time.
  static constexpr float binary32_slack = 1 + 12 * 0x1p-24f;  // 1 + 12u
  static constexpr float underflow_floor = 0x1p-120f;
  static constexpr double binary64_slack = 1 + 10 * 0x1p-53;  // 1 + 10u

 private:
  enum class Decision { separate, overlap, open };

  static constexpr float safe_square_min = 0x1p-90f, safe_square_max = 0x1p120f;
  static constexpr float safe_radius_min = 0x1p-45f, safe_radius_max = 0x1p60f;  // their roots
  static constexpr float contained_slack = 1 + 6 * 0x1p-24f;                     // 1 + 6u
  static constexpr float parent_slack = 1 + 32 * 0x1p-24f;  // 1 + 32u; 25u and 5u of the drift are needed
  static constexpr double parent_binary64_slack = 1 + 0x1p-48;

  /// Stage 1, binary32: q = |cA - cB|^2 with relative error <= 5.01u, t = (rA + rB)^2 with <= 3.01u, and,
  /// where they underflow, an absolute error below 2^-146.
  struct Binary32 {
    CATENA_HD Binary32(const Sphere& a, const Sphere& b) {
      const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.radius + b.radius;
      q = dx * dx + dy * dy + dz * dz;
      t = reach * reach;
    }
    /// For certain, whatever the range: an overflowing q is truly greater than a finite t, an overflowing t
    /// is never less, and the floor outweighs every underflow.
    CATENA_HD bool separate() const { return q > t * binary32_slack + underflow_floor; }
    /// Stage 1 decides all that it ever can.
    CATENA_HD bool in_range() const { return t > safe_square_min && t < safe_square_max; }
    float q, t;

    /// q with fused products where they are faster: what it decides is certain either way, and need not be
    /// alike on host and device.
    CATENA_HD static float fused_square(const Sphere& a, const Sphere& b) {
      const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      return mul_add(dz, dz, mul_add(dy, dy, dx * dx));
    }
    /// Above it q is separate, where nothing underflows; a constant of a loop over spheres of one radius.
    CATENA_HD static float greatest_square(const Sphere& a, const Sphere& b) {
      const float reach = a.radius + b.radius;
      return reach * reach * binary32_slack;
    }
  };

  /// Stage 2, binary64: no binary32 input can overflow or underflow here.
  CATENA_HD static Decision decide_in_binary64(const Sphere& a, const Sphere& b) {
    const double dx = double(b.x) - a.x, dy = double(b.y) - a.y, dz = double(b.z) - a.z;
    const double reach = double(a.radius) + b.radius;
    const double q = dx * dx + dy * dy + dz * dz, t = reach * reach;
    if (q > t * binary64_slack) return Decision::separate;
    if (q * binary64_slack < t) return Decision::overlap;
    return Decision::open;
  }

  /// Stages 2 and 3. Spheres come by value: an address would force them out of a kernel's registers.
  CATENA_COLD static bool overlap_undecided(Sphere a, Sphere b) {
    const Decision second = decide_in_binary64(a, b);
    if (second != Decision::open) return second == Decision::overlap;
    return ExactSign::of_gap(a, b) <= 0;
  }

  /// The parent where binary32 could overflow, underflow or divide by zero: in binary64 throughout, then the
  /// radius measured from the rounded centre and rounded up. An overflowing radius becomes infinite: it
  /// encloses.
  CATENA_COLD static Sphere parent_in_binary64(Sphere a, Sphere b) {
    const double d = distance(a, b), ra = a.radius, rb = b.radius;
    if (d == 0) return ra < rb ? b : a;
    if ((d + rb) * parent_binary64_slack <= ra) return a;
    if ((d + ra) * parent_binary64_slack <= rb) return b;
    const double t = clamp01((0.5 * (d + ra + rb) - ra) / d);
    Sphere c{float(a.x + t * (double(b.x) - a.x)), float(a.y + t * (double(b.y) - a.y)),
             float(a.z + t * (double(b.z) - a.z)), 0};
    c.radius = round_up(larger(distance(c, a) + ra, distance(c, b) + rb) * parent_binary64_slack);
    return c;
  }

  CATENA_HD static double distance(const Sphere& a, const Sphere& b) {
    using std::sqrt;
    const double dx = double(b.x) - a.x, dy = double(b.y) - a.y, dz = double(b.z) - a.z;
    return sqrt(dx * dx + dy * dy + dz * dz);
  }
  template <class Real>
  CATENA_HD static Real larger(Real p, Real q) {
    return p < q ? q : p;
  }
  template <class Real>
  CATENA_HD static Real clamp01(Real t) {
    return t < 0 ? Real(0) : t > 1 ? Real(1) : t;
  }
  /// The least binary32 >= value, for value > 0.
  CATENA_HD static float round_up(double value) {
    float nearest = float(value);
    if (double(nearest) >= value) return nearest;
    std::uint32_t bits;
    std::memcpy(&bits, &nearest, sizeof bits);
    ++bits;
    std::memcpy(&nearest, &bits, sizeof bits);
    return nearest;
  }
};

}  // namespace catena

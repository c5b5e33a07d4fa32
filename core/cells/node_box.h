#pragma once
#include <cmath>
#include <cstdint>

#include "catena/core/cells/block_capsule.h"

namespace catena {

/// How far things reach along the three axes of a box, from its centre.
struct AxisIntervals {
  float low[3], high[3];
};

/// All points p with |(p - centre) . axis| <= half for each of three axes, which are orthonormal to within
/// BlockTree::axes_error: what a node of blocks lies in, with the formulas, slacks and units of core/blocks/
/// (oriented_box_binary32.g, capsule_binary32.g), one box at a time.
struct alignas(16) NodeBox {
  Vector32 centre;
  Vector32 axis[3];
  float half[3];
  /// Not 0: certain that no child meets the next but one, or a later one; known of children that are blocks.
  std::uint32_t in_a_row;

  /// Slack of intervals for the way from a centre to another, relative to the sum of its sides.
  static constexpr float centre_slack = 0x1p-20f;  // 16 u

  CATENA_HD float sides() const { return half[0] + half[1] + half[2]; }

  /// How far a capsule reaches along these axes, outward: what its radius has on top covers the rounding of
  /// the half axis's part, the rest that of the centre's, of the sums, and of axes a little longer than 1.
  CATENA_HD AxisIntervals intervals(const BlockCapsule& c) const {
    const Vector32 t = c.centre - centre;
    const float radius = mul_add(sum_of_sides(t), centre_slack, c.radius * (1 + BlockTree::axes_slack));
    AxisIntervals result;
    for (int k = 0; k < 3; ++k) {
      const float middle = dot(t, axis[k]), reach = std::fabs(dot(c.half, axis[k])) + radius;
      result.low[k] = middle - reach, result.high[k] = middle + reach;
    }
    return result;
  }
  /// The same of another box: it reaches sum |v_j . u| half_j along u, and for axes that are orthonormal but
  /// for axes_error, axes_slack times sum half_j more.
  CATENA_HD AxisIntervals intervals(const NodeBox& b) const {
    const Vector32 t = b.centre - centre;
    const float slack =
        mul_add(b.sides(), BlockTree::axes_slack, mul_add(sum_of_sides(t), centre_slack, BlockTree::tiny));
    AxisIntervals result;
    for (int k = 0; k < 3; ++k) {
      const float middle = dot(t, axis[k]);
      float reach = slack;
      for (int j = 0; j < 3; ++j) reach = mul_add(std::fabs(dot(b.axis[j], axis[k])), b.half[j], reach);
      result.low[k] = middle - reach, result.high[k] = middle + reach;
    }
    return result;
  }

  /// False only when nothing in the other one lies in this box, as far as this box's axes say.
  template <class Bound>
  CATENA_HD bool may_hold(const Bound& other) const {
    const AxisIntervals of = intervals(other);
    bool meets = true;
    for (int k = 0; k < 3; ++k) meets = meets & (of.low[k] <= half[k]) & (-half[k] <= of.high[k]);
    return meets;
  }
};

/// A direction in which a symmetric matrix stretches most, or least.
class PrincipalAxes {
 public:
  struct Symmetric {
    float xx, xy, xz, yy, yz, zz;
  };

  /// Sets axes that are orthonormal to within BlockTree::axes_error, which is checked: where the guess is
  /// not, the axes of space are taken. The guess is made by eight powers of the covariance, longest first,
  /// and of its adjugate, flattest last.
  CATENA_HD static void of(const Symmetric& covariance, Vector32 (&axis)[3]) {
    Symmetric longest = normalized(covariance), flattest = adjugate(longest);
    const bool line = trace(flattest) < 1e-5f;  // then only the longest is sharp
    flattest = normalized(flattest);
    for (int k = 0; k < 3; ++k)
      longest = normalized(squared(longest)), flattest = normalized(squared(flattest));
    const Vector32 t = unit(main_column(longest)), n = unit(main_column(flattest)), kept = line ? t : n;
    Vector32 turned = line ? n : t;
    turned = plus(turned, -dot(kept, turned), kept);
    // Where the two were one, any direction across will do: the axis of space that is least along it.
    if (!(dot(turned, turned) > 1e-3f)) turned = across(kept);
    for (int k = 0; k < 2; ++k) turned = unit(plus(turned, -dot(kept, turned), kept));
    axis[0] = line ? kept : turned, axis[2] = line ? turned : kept;
    axis[1] = cross(axis[2], axis[0]);
    bool orthonormal = true;  // a comparison with a NaN is false
    for (int i = 0; i < 3; ++i) {
      const bool one_long = (std::fabs(dot(axis[i], axis[i]) - 1) < BlockTree::axes_error);
      const bool square = (std::fabs(dot(axis[i], axis[(i + 1) % 3])) < BlockTree::axes_error);
      orthonormal = orthonormal & one_long & square;
    }
    if (!orthonormal) axis[0] = {1, 0, 0}, axis[1] = {0, 1, 0}, axis[2] = {0, 0, 1};
  }

 private:
  CATENA_HD static float trace(const Symmetric& m) { return m.xx + m.yy + m.zz; }
  CATENA_HD static Symmetric normalized(const Symmetric& m) {
    const float s = 1 / std::fmax(trace(m), 1e-30f);
    return {m.xx * s, m.xy * s, m.xz * s, m.yy * s, m.yz * s, m.zz * s};
  }
  CATENA_HD static Symmetric squared(const Symmetric& m) {
    const Vector32 x{m.xx, m.xy, m.xz}, y{m.xy, m.yy, m.yz}, z{m.xz, m.yz, m.zz};
    return {dot(x, x), dot(x, y), dot(x, z), dot(y, y), dot(y, z), dot(z, z)};
  }
  /// The same eigenvectors, the greatest for the least.
  CATENA_HD static Symmetric adjugate(const Symmetric& m) {
    return {m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
            m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
  }
  /// The column of the greatest diagonal element: after some squarings the eigenvector of the greatest
  /// eigenvalue.
  CATENA_HD static Vector32 main_column(const Symmetric& m) {
    Vector32 column{m.xx, m.xy, m.xz};
    if (m.xx < m.yy) column = {m.xy, m.yy, m.yz};
    if (std::fmax(m.xx, m.yy) < m.zz) column = {m.xz, m.yz, m.zz};
    return column;
  }
  CATENA_HD static Vector32 unit(const Vector32& v) {
    const float s = 1 / std::sqrt(dot(v, v));
    return {v.x * s, v.y * s, v.z * s};
  }
  CATENA_HD static Vector32 across(const Vector32& v) {
    const float x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
    Vector32 result{0, 0, 1};
    if (y <= z) result = {0, 1, 0};
    if (x <= y && x <= z) result = {1, 0, 0};
    return result;
  }
  CATENA_HD static Vector32 cross(const Vector32& a, const Vector32& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

/// Fits the box of a node by a team of as many threads as it has children; at(k) is a child's bound, that of
/// the last where there are fewer.
template <class Team, class At>
class NodeFit {
 public:
  CATENA_HD NodeFit(const Team& team, const At& at) : team_(team), at_(at) {}

  CATENA_HD NodeBox box() const {
    NodeBox result;
    guess(result);
    const auto first = team_.each([&](std::uint32_t lane) { return result.intervals(at_(lane)); });
    for (int k = 0; k < 3; ++k) {
      const float high = team_.greatest([&](std::uint32_t lane) { return first[lane].high[k]; }),
                  low = -team_.greatest([&](std::uint32_t lane) { return -first[lane].low[k]; });
      result.centre = plus(result.centre, 0.5f * (low + high), result.axis[k]);
    }
    // Measured again from the centre as it is stored.
    const auto all = team_.each([&](std::uint32_t lane) { return result.intervals(at_(lane)); });
    for (int k = 0; k < 3; ++k)
      result.half[k] = team_.greatest([&](std::uint32_t lane) {
        return std::fmax(std::fmax(all[lane].high[k], -all[lane].low[k]), 0.0f);
      });
    result.in_a_row = 0;
    return result;
  }

  /// Whether the children follow one another along the longest axis, one way or the other.
  CATENA_HD bool in_a_row(const NodeBox& box) const {
    const auto along = [&](std::uint32_t k) {
      const AxisIntervals all = box.intervals(at_(k));
      return Interval{all.low[0], all.high[0]};
    };
    const auto rises = [&](std::uint32_t k, bool falling) {
      if (k + 1 >= Team::lanes) return true;
      const Interval own = along(k), next = along(k + 1);
      if (falling ? next.high > own.high : next.low < own.low) return false;
      if (k + 2 >= Team::lanes) return true;
      const Interval later = along(k + 2);
      return falling ? later.high < own.low : own.high < later.low;
    };
    const bool up = team_.none([&](std::uint32_t k) { return !rises(k, false); }),
               down = team_.none(
                   [&](std::uint32_t k) { return !rises(k, true); });  // by all teams, whatever `up`
    return up || down;
  }

 private:
  struct Interval {
    float low, high;
  };
  using Symmetric = PrincipalAxes::Symmetric;

  /// The covariance of what fills a child evenly, about its centre. Without it the axes of a path that goes
  /// back and forth would be those of where its parts happen to have their middles.
  CATENA_HD static Symmetric spread(const BlockCapsule& c) {
    Symmetric result{};
    add(c.half, 1.0f / 3, result);
    return result;
  }
  CATENA_HD static Symmetric spread(const NodeBox& b) {
    Symmetric result{};
    for (int k = 0; k < 3; ++k) add(b.axis[k], b.half[k] * b.half[k] * (1.0f / 3), result);
    return result;
  }
  CATENA_HD static void add(const Vector32& v, float weight, Symmetric& to) {
    const Vector32 w{weight * v.x, weight * v.y, weight * v.z};
    to.xx += w.x * v.x, to.xy += w.x * v.y, to.xz += w.x * v.z;
    to.yy += w.y * v.y, to.yz += w.y * v.z, to.zz += w.z * v.z;
  }

  /// Axes and about the centre, from where the children lie and how they are spread.
  CATENA_HD void guess(NodeBox& box) const {
    const Vector32 origin = at_(0).centre;
    const auto p = team_.each([&](std::uint32_t lane) { return at_(lane).centre - origin; });
    const auto own = team_.each([&](std::uint32_t lane) { return spread(at_(lane)); });
    const auto sum = [&](float Vector32::*a) {
      return team_.sum([&](std::uint32_t lane) { return p[lane].*a; });
    };
    const Vector32 all{sum(&Vector32::x), sum(&Vector32::y), sum(&Vector32::z)};
    constexpr float part = 1.0f / Team::lanes;
    const Vector32 mean{all.x * part, all.y * part, all.z * part};
    const auto moment = [&](float Vector32::*a, float Vector32::*b, float Symmetric::*of_own) {
      const float about_origin =
          team_.sum([&](std::uint32_t lane) { return p[lane].*a * (p[lane].*b) + own[lane].*of_own; });
      return about_origin - all.*a * (mean.*b);
    };
    const auto x = &Vector32::x, y = &Vector32::y, z = &Vector32::z;
    using S = Symmetric;
    PrincipalAxes::of({moment(x, x, &S::xx), moment(x, y, &S::xy), moment(x, z, &S::xz), moment(y, y, &S::yy),
                       moment(y, z, &S::yz), moment(z, z, &S::zz)},
                      box.axis);
    box.centre = origin + mean;
  }

  const Team& team_;
  const At& at_;
};

}  // namespace catena

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/properties/mutants/mutant.h"

// Bugs in the decision whether two spheres overlap.
namespace catena::properties {
namespace {

/// Decides by a and b alone.
class WrongOverlap : public FaultyTree {
  bool collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    return overlap(chain.spheres[std::min(i, j)], chain.spheres[std::max(i, j)]);
  }
  virtual bool overlap(const Sphere& a, const Sphere& b) const = 0;
};

struct Squares {
  float q, t;
  static Squares plain(const Sphere& a, const Sphere& b) {
    const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.radius + b.radius;
    return {dx * dx + dy * dy + dz * dz, reach * reach};
  }
  static Squares fused(const Sphere& a, const Sphere& b) {
    const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.radius + b.radius;
    return {std::fma(dz, dz, std::fma(dy, dy, dx * dx)), reach * reach};
  }
};

class TouchingIsApart final : public WrongOverlap {
  bool overlap(const Sphere& a, const Sphere& b) const override { return ExactSign::of_gap(a, b) < 0; }
};
const RegisterMutant<TouchingIsApart> touching{"less-for-less-equal", "fcl#281: kissing contact undecided"};

class PlainFloat final : public WrongOverlap {
  bool overlap(const Sphere& a, const Sphere& b) const override { return Literal::overlap(a, b); }
};
const RegisterMutant<PlainFloat> plain{"binary32-near-a-tie", "the rounded inequality decides"};

class AbsoluteTolerance final : public WrongOverlap {
  bool overlap(const Sphere& a, const Sphere& b) const override {
    const Sphere wider{a.x, a.y, a.z, a.radius + 1e-6f};
    return ExactSign::of_gap(wider, b) <= 0;
  }
};
const RegisterMutant<AbsoluteTolerance> absolute{"absolute-tolerance", "fcl#278: tolerances do not scale"};

/// The spheres that are found from i differ from those that find i.
class FusedOnOneSide final : public FaultyTree {
  bool collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    const Sphere &a = chain.spheres[std::min(i, j)], &b = chain.spheres[std::max(i, j)];
    const Squares s = i < j ? Squares::fused(a, b) : Squares::plain(a, b);
    return std::isnormal(s.t) && std::fabs(s.q / s.t - 1) < 1e-6f ? s.q <= s.t
                                                                  : FaultyTree::collide(chain, i, j);
  }
};
const RegisterMutant<FusedOnOneSide> fused{"fused-on-one-side",
                                           "celeritas PR#2471: contraction on one architecture"};

class SquareOverflows final : public WrongOverlap {
  bool overlap(const Sphere& a, const Sphere& b) const override {
    const Squares s = Squares::plain(a, b);
    return std::isinf(s.q) || std::isinf(s.t) ? s.q <= s.t : ExactSign::of_gap(a, b) <= 0;
  }
};
const RegisterMutant<SquareOverflows> overflow{"square-overflows",
                                               "infinity <= infinity: far spheres collide"};

class SquareUnderflows final : public WrongOverlap {
  bool overlap(const Sphere& a, const Sphere& b) const override {
    const Squares s = Squares::plain(a, b);
    return s.q < 0x1p-126f && s.t < 0x1p-126f ? s.q <= s.t : ExactSign::of_gap(a, b) <= 0;
  }
};
const RegisterMutant<SquareUnderflows> underflow{"square-underflows", "0 <= 0: tiny spheres all collide"};

/// The slack that should widen the binary64 decision is written as a float and vanishes.
class FloatConstant final : public WrongOverlap {
  bool overlap(const Sphere& a, const Sphere& b) const override {
    constexpr double slack = 1.0f + 1e-9f;
    const Sphere64 p = Double::bound(a), q = Double::bound(b);
    const double dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z, reach = p.radius + q.radius;
    const double gap = dx * dx + dy * dy + dz * dz - reach * reach * slack;
    return gap > 0 ? false : gap < 0 ? true : reach > 0 || dx * dx + dy * dy + dz * dz == 0;
  }
};
const RegisterMutant<FloatConstant> constant{"float-constant-in-double-path", "ArborX PR#1195"};

/// Numbers below the normal range are zero.
class FlushesSubnormals final : public FaultyTree {
  bool collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const override {
    return Robust::overlap(flushed(chain.spheres[i]), flushed(chain.spheres[j]));
  }
  static Sphere flushed(const Sphere& s) {
    const auto flush = [](float v) { return std::fabs(v) < std::numeric_limits<float>::min() ? 0.0f : v; };
    return {flush(s.x), flush(s.y), flush(s.z), flush(s.radius)};
  }
};
const RegisterMutant<FlushesSubnormals> flushes{
    "flushes-subnormals", "catena itself in a program linked with -ffast-math: 1,122,751 pairs instead of 1,047"};

/// Boxes are kept as min and max, but compared as centre and extent.
class CentreExtent final : public WrongOverlap {
  struct Axis {
    float centre, extent;
    static Axis of(float centre, float radius) {
      const float low = centre - radius, high = centre + radius;
      return {0.5f * (low + high), 0.5f * (high - low)};
    }
    bool meets(const Axis& other) const { return std::fabs(centre - other.centre) <= extent + other.extent; }
  };
  bool overlap(const Sphere& a, const Sphere& b) const override {
    return Axis::of(a.x, a.radius).meets(Axis::of(b.x, b.radius)) &&
           Axis::of(a.y, a.radius).meets(Axis::of(b.y, b.radius)) &&
           Axis::of(a.z, a.radius).meets(Axis::of(b.z, b.radius)) && ExactSign::of_gap(a, b) <= 0;
  }
};
const RegisterMutant<CentreExtent> round_trip{"centre-extent-round-trip",
                                              "PhysX#533: min/max to centre/extent"};

}  // namespace
}  // namespace catena::properties

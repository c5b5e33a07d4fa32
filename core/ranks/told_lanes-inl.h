// What ToldBlock says, of eight spheres at a time in binary32, where that is certain. Compiled once a target.
#if defined(CATENA_CORE_RANKS_TOLD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_RANKS_TOLD_LANES_INL_H
#undef CATENA_CORE_RANKS_TOLD_LANES_INL_H
#else
#define CATENA_CORE_RANKS_TOLD_LANES_INL_H
#endif

#include <algorithm>
#include <limits>

#include "catena/core/blocks/lanes-inl.h"
#include "catena/core/ranks/told_block.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// The capsule of a block in every lane. With the formulas of told_block.cpp; products have a little on top
/// (`least`), so that none that matters loses digits to underflow, and what overflows is certain of nothing.
class ToldLanes {
 public:
  using Vectors8 = VectorsOf<8>;
  static constexpr float slack = 0x1p-16f;  ///< properties/proofs/told_block_binary32.g

  HWY_INLINE explicit ToldLanes(const ranks::ToldBlock& told)
      : first_{Lanes8::all(told.first[0]), Lanes8::all(told.first[1]), Lanes8::all(told.first[2])},
        axis_{Vectors8{Lanes8::all(told.last[0]), Lanes8::all(told.last[1]), Lanes8::all(told.last[2])} -
              first_},
        radius_(Lanes8::all(told.radius)) {
    Lanes8 one = Lanes8::all(1);
    over_square_ = one / dot(axis_, axis_, least());
    sides_ = sum_of_sides(axis_);
  }

  /// Those of eight spheres that may touch the capsule, a bit each; a few more than ToldBlock says.
  HWY_INLINE std::uint32_t may_touch(const Sphere* eight) const {
    const Spheres s(eight);
    Vectors8 to = s.centre - first_, across = this->across(to);
    Lanes8 at_first = dot(to, across, least());
    Lanes8 gap = min(at_first, at_first - dot(axis_, across, least()));
    Lanes8 reach = radius_ + s.radius + lost(to);
    Lanes8 none = Lanes8::all(0), gap_square = max(gap, none) * gap, reach_square = reach * reach;
    return ~(mul_add(reach_square, dot(across, across, least()), least()) < gap_square).bits() & 0xFF;
  }

  /// A radius around the axis that holds the first `size` of eight spheres; what is no number above 2^-40
  /// says nothing.
  HWY_INLINE float holding(const Sphere* eight, std::uint32_t size) const {
    const Spheres s(eight);
    Vectors8 to = s.centre - first_, across = this->across(to);
    float radius[8];
    (sqrt(dot(across, across, least())) + s.radius + lost(to)).store(radius);
    constexpr float infinite = std::numeric_limits<float>::infinity();
    // What is no number is no greatest one either, but where it comes first.
    if (!std::all_of(radius, radius + size, [](float r) { return r < infinite; })) return infinite;
    return *std::max_element(radius, radius + size) * (1 + 0x1p-20f);
  }

 private:
  struct Spheres {
    Vectors8 centre;
    Lanes8 radius;
    HWY_INLINE explicit Spheres(const Sphere* eight) {
      using Tag = Lanes8::Tag;
      for (std::size_t k = 0; k < Lanes8::parts; ++k)
        hn::LoadInterleaved4(Tag(), reinterpret_cast<const float*>(eight + k * Lanes8::width),
                             centre.x.part[k], centre.y.part[k], centre.z.part[k], radius.part[k]);
    }
  };

  static HWY_INLINE Lanes8 least() { return Lanes8::all(least_product); }
  HWY_INLINE Vectors8 across(const Vectors8& to) const {
    Lanes8 part = dot(axis_, to) * over_square_;
    return minus(to, max(min(part, Lanes8::all(1)), Lanes8::all(0)), axis_);
  }
  HWY_INLINE Lanes8 lost(const Vectors8& to) const {
    return mul_add(sides_ + sum_of_sides(to), Lanes8::all(slack), Lanes8::all(0x1p-50f));
  }

  Vectors8 first_, axis_;
  Lanes8 radius_, over_square_, sides_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

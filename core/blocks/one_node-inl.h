// The box of a node that is alone on its level, lane = child: the top of every tree, and all of a short
// chain's.
#if defined(CATENA_CORE_BLOCKS_ONE_NODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_ONE_NODE_INL_H
#undef CATENA_CORE_BLOCKS_ONE_NODE_INL_H
#else
#define CATENA_CORE_BLOCKS_ONE_NODE_INL_H
#endif

#include "catena/core/blocks/node_axes-inl.h"
#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/blocks/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// In all lanes.
HWY_INLINE Lanes16 sum_of_lanes(const Lanes16& a) {
  auto sum = a.part[0];
  for (std::size_t k = 1; k < Lanes16::parts; ++k) sum = hn::Add(sum, a.part[k]);
  return Lanes16::all(hn::GetLane(hn::SumOfLanes(Lanes16::Tag(), sum)));
}
HWY_INLINE Lanes16 greatest_of_lanes(const Lanes16& a) {
  auto greatest = a.part[0];
  for (std::size_t k = 1; k < Lanes16::parts; ++k) greatest = hn::Max(greatest, a.part[k]);
  return Lanes16::all(hn::GetLane(hn::MaxOfLanes(Lanes16::Tag(), greatest)));
}
HWY_INLINE Vectors sum_of_lanes(const Vectors& v) {
  return {sum_of_lanes(v.x), sum_of_lanes(v.y), sum_of_lanes(v.z)};
}
HWY_INLINE Symmetric sum_of_lanes(const Symmetric& m) {
  Vectors x = sum_of_lanes(Vectors{m.xx, m.xy, m.xz}), z = sum_of_lanes(Vectors{m.yy, m.yz, m.zz});
  return {x.x, x.y, x.z, z.x, z.y, z.z};
}

/// The children of a node; the last for what is missing of sixteen.
template <class Sixteen>
HWY_INLINE Sixteen children_of_one(const float* children, std::uint32_t count) {
  constexpr std::uint32_t group = BlockTree::group;
  if (count == group) return Sixteen::load(children);
  alignas(64) float filled[std::size_t{group} * Sixteen::fields], lane[group];
  for (std::uint32_t k = 0; k < group; ++k) lane[k] = static_cast<float>(k);
  Flags<16> there = Lanes16::load(lane) < Lanes16::all(static_cast<float>(count));
  for (std::uint32_t f = 0; f < group * Sixteen::fields; f += group)
    select(there, Lanes16::load(children + f), Lanes16::all(children[f + count - 1])).store(filled + f);
  return Sixteen::load(filled);
}

/// Whether intervals that follow one another are in a row, as Rows tells it of one lane.
HWY_INLINE bool in_a_row(const Interval& child, std::uint32_t count) {
  const auto one_on = [](const Lanes16& a) HWY_ATTR { return shifted(a, 0); };
  Lanes16 low = one_on(child.low), high = one_on(child.high);
  const std::uint32_t next = lane_bits(count - 1), next_but_one = count > 2 ? lane_bits(count - 2) : 0;
  const auto holds = [](const Flags<16>& flags, std::uint32_t lanes)
                         HWY_ATTR { return (flags.bits() & lanes) == lanes; };
  return holds(child.low <= child.high, 1) &&
         ((holds(child.low <= low, next) && holds(child.high < one_on(low), next_but_one)) ||
          (holds(high <= child.high, next) && holds(one_on(high) < child.low, next_but_one)));
}

/// Its box, in all lanes, and whether its children are in a row along the longest axis.
template <class Sixteen>
HWY_INLINE bool build_one_node(const float* fields, std::uint32_t count, float* to) {
  Sixteen children = children_of_one<Sixteen>(fields, count);
  Vectors origin = Vectors::all(fields, 0), p = children.centre - origin;
  OrientedBoxes box = box_guess(origin, sum_of_lanes(p), sum_of_lanes(Symmetric::least().plus_square_of(p)),
                                sum_of_lanes(plus_spread(Symmetric::least(), children)));
  Lanes16 zero = Lanes16::all(0), half = Lanes16::all(0.5f);
  Intervals reach = intervals(children, box.centre, box.axis);
  for (int k = 0; k < 3; ++k) {
    Lanes16 high = greatest_of_lanes(reach.high[k]), low = greatest_of_lanes(zero - reach.low[k]);
    box.centre = plus(box.centre, half * (high - low), box.axis[k]);
  }
  reach = intervals(children, box.centre, box.axis);
  for (int k = 0; k < 3; ++k)
    box.half[k] = max(zero, greatest_of_lanes(max(reach.high[k], zero - reach.low[k])));
  box.store(to);
  return in_a_row({reach.low[0], reach.high[0]}, count);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// The pairs of entries of a SpaceTree whose boxes meet.
#if defined(CATENA_CORE_SPACE_TREE_SPACE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_SPACE_WALK_INL_H
#undef CATENA_CORE_SPACE_TREE_SPACE_WALK_INL_H
#else
#define CATENA_CORE_SPACE_TREE_SPACE_WALK_INL_H
#endif

#include <span>

#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/space_tree/axis_boxes-inl.h"
#include "catena/core/space_tree/space_evidence.h"
#include "catena/core/space_tree/space_queue.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Take has skip(a, b), whether pairs of nodes a and b are of no interest, and take(pairs), of entries whose
/// boxes meet; each pair once, and at most `room` at a time. Sink has the members of SpaceEvidence;
/// NoSpaceEvidence costs nothing.
template <class Take, class Sink = const NoSpaceEvidence>
class SpaceWalk {
 public:
  SpaceWalk(const SpaceTree& space, SpaceQueue& queue, Take& take, Sink& sink)
      : space_(space), take_(take), sink_(sink), done_(queue.done), queue_(queue.pairs.data()) {}

  /// Node a with itself, and with each later one; or, with `all`, with every other.
  void node(std::uint32_t a, bool all) {
    if (!take_.skip(a, a)) within(a);
    if (space_.boxes.size() == 1) return;
    AxisBoxes box = AxisBoxes::all(space_.boxes_of(1, a / group), a % group);
    down(space_.boxes.size() - 1, 0, a, box, all);
  }
  void finish() { hand_over(); }

 private:
  static constexpr std::uint32_t group = SpaceTree::group;
  using Bits = hn::RebindToUnsigned<Lanes16::Tag>;

  void within(std::uint32_t a) {
    const float* const boxes = space_.boxes_of(0, a);
    AxisBoxes those = AxisBoxes::load(boxes);
    for (std::uint32_t i = 0; i + 1 < group; ++i)
      add(a * group + i, a * group, meet(AxisBoxes::all(boxes, i), those),
          lane_bits(group) & ~((2u << i) - 1));
    make_room();
  }

  /// Node a, in `box`, with those below group g of level l.
  void down(std::size_t l, std::uint32_t g, std::uint32_t a, const AxisBoxes& box, bool all) {
    const std::uint32_t met = meet(box, AxisBoxes::load(space_.boxes_of(l, g))).bits();
    if constexpr (Sink::listens)
      for_each_lane(there(l, g) & ~met, [&](std::uint32_t k) {
        const std::uint32_t child = g * group + k;
        if ((std::uint64_t{child} << (4 * (l - 1))) > a) sink_.nodes_apart(a, l, child);
      });
    for_each_lane(met, [&](std::uint32_t k) {
      const std::uint32_t child = g * group + k;
      if (l == 1) {
        if ((child > a || (all && child != a)) && !take_.skip(a, child)) between(a, child, box);
      } else if (all || ((std::uint64_t{child} + 1) << (4 * (l - 1))) > std::uint64_t{a} + 1) {
        down(l - 1, child, a, box, all);
      }
    });
  }

  void between(std::uint32_t a, std::uint32_t b, const AxisBoxes& box_a) {
    const float* const boxes = space_.boxes_of(0, a);
    AxisBoxes those = AxisBoxes::load(space_.boxes_of(0, b));
    AxisBoxes box_b = AxisBoxes::all(space_.boxes_of(1, b / group), b % group);
    const std::uint32_t theirs = meet(box_a, those).bits();
    if constexpr (Sink::listens)
      for_each_lane(there(0, b) & ~theirs, [&](std::uint32_t j) { sink_.box_apart(a, b * group + j); });
    if (theirs == 0) return;
    const std::uint32_t mine = meet(box_b, AxisBoxes::load(boxes)).bits();
    if constexpr (Sink::listens)
      for_each_lane(there(0, a) & ~mine, [&](std::uint32_t i) {
        for_each_lane(theirs, [&](std::uint32_t j) { sink_.boxes_apart(a * group + i, b * group + j); });
      });
    for_each_lane(mine, [&](std::uint32_t i) {
      add(a * group + i, b * group, meet(AxisBoxes::all(boxes, i), those), theirs);
    });
    make_room();
  }

  /// Entry i and those from `first` on that are met and among the candidates.
  HWY_INLINE void add(std::uint32_t i, std::uint32_t first, const Flags<16>& met, std::uint32_t candidates) {
    const Bits bits;
    if constexpr (Sink::listens)
      for_each_lane(candidates & ~met.bits() & there(0, first / group),
                    [&](std::uint32_t k) { sink_.boxes_apart(i, first + k); });
    for (std::uint32_t k = 0; k < Lanes16::parts; ++k) {
      constexpr std::uint32_t width = Lanes16::width;
      const auto wanted = lanes_of(bits, candidates >> (k * width));
      size_ += store_pairs(bits, i, count_up(bits, first + k * width),
                           hn::And(hn::RebindMask(bits, met.part[k]), wanted), queue_ + size_);
    }
  }
  /// Those of group g of a level that there are.
  std::uint32_t there(std::size_t l, std::uint32_t g) const {
    std::uint32_t count = space_.entries;
    for (; l > 0; --l) count = (count + group - 1) / group;
    return lane_bits(std::min(group, count - g * group));
  }
  void make_room() {
    if (size_ > SpaceQueue::limit) hand_over();
  }
  void hand_over() {
    take_.take(std::span<const Pair>(queue_, size_));
    done_ += size_;
    size_ = 0;
  }

  const SpaceTree& space_;
  Take& take_;
  Sink& sink_;
  std::uint64_t& done_;
  Pair* const queue_;
  std::size_t size_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// The colliding pairs of a SpaceTree: boxes, then capsules, sixteen pairs a test, then eight spheres against
// eight.
#if defined(CATENA_CORE_SPACE_TREE_SEARCH_SPACE_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_SEARCH_SPACE_TREE_INL_H
#undef CATENA_CORE_SPACE_TREE_SEARCH_SPACE_TREE_INL_H
#else
#define CATENA_CORE_SPACE_TREE_SEARCH_SPACE_TREE_INL_H
#endif

#include <algorithm>
#include <array>
#include <type_traits>

#include "catena/core/blocks/leaf_pairs-inl.h"
#include "catena/core/blocks/neighbour_blocks.h"
#include "catena/core/space_tree/space_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Near has near(a, b), called for each pair of entries whose capsules may collide; for others apart(a, b).
template <class Near, class Apart>
HWY_INLINE void for_each_near(const SpaceTree& space, std::span<const Pair> entries, const Near& near,
                              const Apart& apart) {
  constexpr std::uint32_t at_once = SpaceTree::group;
  const float* const capsules = space.capsules.data();
  // One for each end, given on as they are made: a struct of both gcc copies before the test, with AVX2, and
  // one function for both ends takes a tenth longer there.
  const auto of_i = [=](const Pair* pairs) HWY_ATTR {
    return Capsules::of_rows(
        [=](std::size_t k) { return capsules + std::size_t{pairs[k].i} * Capsules::fields; });
  };
  const auto of_j = [=](const Pair* pairs) HWY_ATTR {
    return Capsules::of_rows(
        [=](std::size_t k) { return capsules + std::size_t{pairs[k].j} * Capsules::fields; });
  };
  const auto told = [&](const Pair* pairs, std::uint32_t may, std::uint32_t count) HWY_ATTR {
    for_each_lane(may & lane_bits(count), [&](std::uint32_t k) { near(pairs[k].i, pairs[k].j); });
    if constexpr (Apart::listens)
      for_each_lane(~may & lane_bits(count), [&](std::uint32_t k) { apart(pairs[k].i, pairs[k].j); });
  };
  const auto test = [&](const Pair* pairs, std::uint32_t count) HWY_ATTR {
    told(pairs, may_collide(of_i(pairs), of_j(pairs)), count);
  };
  if constexpr (Lanes16::parts == 1) {
    for (; entries.size() >= 2 * at_once; entries = entries.subspan(2 * at_once)) {
      const Pair *const a = entries.data(), *const b = a + at_once;
      const std::uint32_t may =
          may_collide(side_by_side<16>(of_i(a), of_i(b)), side_by_side<16>(of_j(a), of_j(b)));
      told(a, may & 0xFFFF, at_once);
      told(b, may >> at_once, at_once);
    }
  }
  for (; entries.size() >= at_once; entries = entries.subspan(at_once)) test(entries.data(), at_once);
  if (entries.empty()) return;
  std::array<Pair, at_once> last;
  std::fill(std::copy(entries.begin(), entries.end(), last.begin()), last.end(), entries.front());
  test(last.data(), static_cast<std::uint32_t>(entries.size()));
}

/// The blocks of two entries as they come along the chain.
inline Pair blocks_of(const SpaceTree& space, std::uint32_t a, std::uint32_t b) {
  return space.whole[a] < space.whole[b] ? Pair{space.block[a], space.block[b]}
                                         : Pair{space.block[b], space.block[a]};
}

/// Reports the spheres that overlap of every two entries, but of two that are dense, and of blocks that
/// follow one another along the chain, which are another search's. Sink as for SpaceWalk.
template <class Sink>
class SpaceSearch {
 public:
  SpaceSearch(const ChainView& chain, const BlockTree& tree, const SpaceTree& space, BlockQueues& queues,
              PairCollector::Lane& lane, Sink& sink)
      : space_(space), sink_(sink), neighbours_(chain, tree), leaves_(chain, tree, queues, lane, sink) {
    queues.clear();  // of what a search left that ended for want of memory
  }

  bool skip(std::uint32_t a, std::uint32_t b) const { return space_.dense_node[a] && space_.dense_node[b]; }

  void take(std::span<const Pair> entries) {
    constexpr std::size_t row = 16;
    std::size_t found = 0;
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
      meet(a, b);
      if (++found % row == 0) leaves_.make_room();
    };
    for_each_near(space_, entries, near, Apart{sink_});
    leaves_.make_room();  // the next begins to count anew
  }
  void finish() { leaves_.flush(); }

 private:
  void meet(std::uint32_t a, std::uint32_t b) {
    if (space_.dense_entry[a] && space_.dense_entry[b]) return;
    const std::uint32_t one = space_.whole[a], other = space_.whole[b];
    if (one - other + 1 <= 2) {  // -1, 0 or 1
      if constexpr (Sink::listens) sink_.left_to_blocks(a, b);
      return;
    }
    const auto [first, second] = blocks_of(space_, a, b);
    if (Sink::listens || !neighbours_.all(first, second)) leaves_.add(first, second);
  }

  struct Apart {
    static constexpr bool listens = Sink::listens;
    Sink& sink;
    void operator()(std::uint32_t a, std::uint32_t b) const { sink.capsules_apart(a, b); }
  };

  const SpaceTree& space_;
  Sink& sink_;
  const NeighbourBlocks neighbours_;
  LeafPairs<std::remove_const_t<Sink>> leaves_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

// From crowded nodes of a BlockTree to a SpaceTree.
#if defined(CATENA_CORE_SPACE_TREE_BUILD_SPACE_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPACE_TREE_BUILD_SPACE_TREE_INL_H
#undef CATENA_CORE_SPACE_TREE_BUILD_SPACE_TREE_INL_H
#else
#define CATENA_CORE_SPACE_TREE_BUILD_SPACE_TREE_INL_H
#endif

#include <algorithm>
#include <limits>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/space_tree/axis_boxes-inl.h"
#include "catena/core/space_tree/cut_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

class SpaceBuild {
 public:
  SpaceBuild(const ChainView& chain, BlockTree& tree, const Crowding& crowding, SpaceTree& space)
      : chain_(chain), tree_(tree), crowding_(crowding), space_(space) {}

  /// Collects entries; false when the chain jumps in most crowded blocks.
  bool collect() {
    space_.unsorted.clear();
    space_.part_of.clear();
    std::uint32_t blocks = 0, broken_blocks = 0;
    for (std::uint32_t g = 0; g < crowding_.nodes(); ++g) {
      if (!crowding_.crowded(g)) continue;
      Sphere copy[(group + 1) * block];
      BlockSpheres spheres;
      load(consecutive_blocks(chain_, tree_, g, copy), Lanes16::all(tree_.scale), spheres);
      const std::uint32_t all = lane_bits(tree_.blocks_of(g));
      if (space_.unsorted.empty()) set_origin(spheres);
      const std::uint32_t broken = cut(tree_, g, spheres,
                                       [&](std::uint32_t b, std::uint32_t first, std::uint32_t size) {
                                         append_copied_block(chain_, tree_.index(b, 0) + first, size, tree_);
                                         space_.part_of.push_back(b);
                                       }) &
                                   all;
      add(spheres, Capsules::load(tree_.capsules_of(g)), all & ~broken, g * group, nullptr);
      blocks += static_cast<std::uint32_t>(std::popcount(all));
      broken_blocks += static_cast<std::uint32_t>(std::popcount(broken));
      if (blocks > group * group && broken_blocks > blocks / 2) return false;
    }
    return true;
  }

  void build() {
    add_parts();
    const auto n = static_cast<std::uint32_t>(space_.unsorted.size());
    space_.order.sort({space_.unsorted[0].low, sizeof(SpaceTree::Unsorted) / sizeof(float), n});
    lay_out();
    for (std::size_t l = 1; l < space_.boxes.size(); ++l) enclose(l);
  }

 private:
  static constexpr std::uint32_t group = SpaceTree::group, block = BlockTree::block,
                                 fields = BlockTree::capsule_fields, box_fields = SpaceTree::box_fields;

  void set_origin(const BlockSpheres& spheres) {
    float x[group], y[group], z[group];
    spheres.at[0].x.store(x), spheres.at[0].y.store(y), spheres.at[0].z.store(z);
    space_.origin[0] = x[0], space_.origin[1] = y[0], space_.origin[2] = z[0];
    origin_ = {Lanes16::all(x[0]), Lanes16::all(y[0]), Lanes16::all(z[0])};
  }

  /// Those of sixteen blocks that are wanted, of the tree from `first` on, become entries; parts are of
  /// `wholes`.
  void add(const BlockSpheres& spheres, const Capsules& capsules, std::uint32_t wanted, std::uint32_t first,
           const std::uint32_t* wholes) {
    float capsule[fields * group], box[box_fields * group];
    capsules.store(capsule);
    boxes_around(spheres, origin_).store(box);
    for_each_lane(wanted, [&](std::uint32_t k) {
      SpaceTree::Unsorted entry;
      for (std::uint32_t f = 0; f < fields; ++f) entry.capsule[f] = capsule[f * group + k];
      for (std::uint32_t d = 0; d < 3; ++d) {
        entry.low[d] = box[d * group + k];
        entry.high[d] = box[(3 + d) * group + k];
      }
      entry.block = first + k;
      entry.whole = wholes == nullptr ? first + k : wholes[k];
      space_.unsorted.push_back(entry);
    });
  }

  void add_parts() {
    const auto parts = static_cast<std::uint32_t>(space_.part_of.size());
    for (std::uint32_t first = 0; first < parts; first += group) {
      Sphere some[group * block];
      for (std::uint32_t k = 0; k < group; ++k)
        std::memcpy(some + k * block, tree_.spheres(chain_, tree_.blocks + std::min(first + k, parts - 1)),
                    sizeof(Sphere) * block);
      BlockSpheres spheres;
      load(some, Lanes16::all(tree_.scale), spheres);
      Lanes16 reach;
      add(spheres, capsules_around(spheres, reach), lane_bits(parts - first), tree_.blocks + first,
          space_.part_of.data() + first);
    }
  }

  /// Entries in their order, and boxes around them.
  void lay_out() {
    const auto n = static_cast<std::uint32_t>(space_.unsorted.size());
    space_.entries = n;
    space_.block.resize(n), space_.whole.resize(n);
    const std::uint32_t nodes = space_.nodes();
    space_.capsules.resize(std::size_t{nodes} * group * fields);
    std::size_t levels = 0;
    for (std::uint32_t count = n; count > 0; count = count > group ? (count + group - 1) / group : 0) {
      if (levels == space_.boxes.size()) space_.boxes.emplace_back();
      space_.boxes[levels++].resize(std::size_t{(count + group - 1) / group} * group * box_fields);
    }
    space_.boxes.resize(levels);
    constexpr float nowhere = std::numeric_limits<float>::infinity();
    for (std::uint32_t k = 0; k < nodes * group; ++k) {
      const SpaceTree::Unsorted& entry = space_.unsorted[space_.order[std::min(k, n - 1)]];
      if (k < n) space_.block[k] = entry.block, space_.whole[k] = entry.whole;
      std::memcpy(space_.capsules.data() + std::size_t{k} * fields, entry.capsule, sizeof entry.capsule);
      float* const box = space_.boxes_of(0, k / group) + k % group;
      for (std::uint32_t d = 0; d < 3; ++d) {
        box[d * group] = k < n ? entry.low[d] : nowhere;
        box[(3 + d) * group] = k < n ? entry.high[d] : -nowhere;
      }
    }
  }

  /// Boxes of level l around sixteen each of the level below.
  void enclose(std::size_t l) {
    const auto count = static_cast<std::uint32_t>(space_.boxes[l - 1].size() / (group * box_fields));
    for (std::uint32_t k = 0; k < (count + group - 1) / group * group; ++k) {
      float* const to = space_.boxes_of(l, k / group) + k % group;
      for (std::uint32_t f = 0; f < box_fields; ++f) {
        const bool low = f < 3;
        float v = low ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
        if (k < count) {
          const float* const of = space_.boxes_of(l - 1, k) + f * group;
          v = low ? *std::min_element(of, of + group) : *std::max_element(of, of + group);
        }
        to[f * group] = v;
      }
    }
  }

  const ChainView& chain_;
  BlockTree& tree_;
  const Crowding& crowding_;
  SpaceTree& space_;
  Vectors origin_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

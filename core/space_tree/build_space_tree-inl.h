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
#include "catena/core/executor/team.h"
#include "catena/core/space_tree/axis_boxes-inl.h"
#include "catena/core/space_tree/cut_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

class SpaceBuild {
 public:
  SpaceBuild(const ChainView& chain, BlockTree& tree, const Crowding& crowding, SpaceTree& space,
             const Team& team)
      : chain_(chain), tree_(tree), crowding_(crowding), space_(space), team_(team) {}

  /// Collects entries; false when the chain jumps in most crowded blocks.
  bool collect() {
    space_.gathered.resize(team_.size());
    for (SpaceTree::Gathered& own : space_.gathered) own.clear();
    set_origin();
    team_.for_each_range(crowding_.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
      SpaceTree::Gathered& own = space_.gathered[team_.member()];
      for (std::uint32_t g = begin; g < end && !own.broken_up(); ++g)
        if (crowding_.crowded(g)) gather(g, own);
    });
    return std::none_of(space_.gathered.begin(), space_.gathered.end(),
                        [](const SpaceTree::Gathered& own) { return own.broken_up(); });
  }

  void build(SpaceSort sort) {
    join();
    const auto n = static_cast<std::uint32_t>(space_.unsorted().size());
    if (sort == SpaceSort::anew || !kept(n)) {
      space_.kept.forget();
      space_.order.sort({space_.unsorted()[0].low, sizeof(SpaceTree::Unsorted) / sizeof(float), n}, team_);
      lay_out_all(n);
      space_.kept.sorted(n, boxes());
    }
    for (std::size_t l = 2; l < space_.boxes.size(); ++l) enclose_all(l);
  }

 private:
  static constexpr std::uint32_t group = SpaceTree::group, block = BlockTree::block,
                                 fields = BlockTree::capsule_fields, box_fields = SpaceTree::box_fields,
                                 nodes_of_a_task = 32;

  /// The order of the last tree serves as many entries, which are laid out by it then: it is one of numbers,
  /// whatever these are of.
  bool kept(std::uint32_t n) {
    if (!space_.kept.may_serve(n)) return false;
    lay_out_all(n);
    return space_.kept.serves(boxes());
  }
  /// Around nodes, which are none where there is but one.
  BoxGroups boxes() const {
    if (space_.boxes.size() < 2) return {nullptr, 0};
    return {space_.boxes_of(1, 0), space_.nodes(), chain_.extent.least_radius * tree_.scale,
            chain_.extent.greatest_radius * tree_.scale};
  }

  void lay_out_all(std::uint32_t n) {
    make_room(n);
    team_.for_each_range(space_.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin * group; k < end * group; ++k) lay_out(k);
    });
    if (space_.boxes.size() > 1) enclose_all(1);
  }
  void enclose_all(std::size_t l) {
    const auto groups = static_cast<std::uint32_t>(space_.boxes[l].size() / (group * box_fields));
    team_.for_each_range(groups, nodes_of_a_task / group, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin * group; k < end * group; ++k) enclose(l, k);
    });
  }

  /// The first sphere of all that are crowded; near enough to all where these are near one another.
  void set_origin() {
    std::uint32_t g = 0;
    while (!crowding_.crowded(g)) ++g;
    const Sphere& first = tree_.spheres(chain_, g * group)[0];
    const float at[3] = {first.x * tree_.unit(), first.y * tree_.unit(), first.z * tree_.unit()};
    std::copy(at, at + 3, space_.origin);
    origin_ = {Lanes16::all(at[0]), Lanes16::all(at[1]), Lanes16::all(at[2])};
  }

  /// The blocks of node g, and the parts of those that are cut.
  void gather(std::uint32_t g, SpaceTree::Gathered& own) const {
    Sphere copy[(group + 1) * block];
    BlockSpheres spheres;
    load(consecutive_blocks(chain_, tree_, g, copy), Lanes16::all(tree_.unit()), spheres);
    const std::uint32_t all = lane_bits(tree_.blocks_of(g));
    const std::uint32_t broken =
        all & cut(tree_, g, spheres, [&](std::uint32_t b, std::uint32_t first, std::uint32_t size) {
          own.parts.push_back({b, tree_.index(b, 0) + first, size});
        });
    const std::size_t before = own.entries.size();
    own.entries.resize(before + static_cast<std::size_t>(std::popcount(all & ~broken)));
    SpaceTree::Unsorted* to = own.entries.data() + before;
    tell(spheres, Capsules::load(tree_.capsules_of(g)), all & ~broken,
         [&](std::uint32_t k) -> SpaceTree::Unsorted& {
           to->block = to->whole = g * group + k;
           return *to++;
         });
    own.blocks += static_cast<std::uint32_t>(std::popcount(all));
    own.broken += static_cast<std::uint32_t>(std::popcount(broken));
  }

  /// Writes capsules and boxes of those of sixteen blocks that are wanted, into entry(k).
  template <class Entry>
  void tell(const BlockSpheres& spheres, const Capsules& capsules, std::uint32_t wanted,
            const Entry& entry) const {
    float capsule[fields * group], box[box_fields * group];
    capsules.store(capsule);
    boxes_around(spheres, origin_).store(box);
    for_each_lane(wanted, [&](std::uint32_t k) {
      SpaceTree::Unsorted& to = entry(k);
      for (std::uint32_t f = 0; f < fields; ++f) to.capsule[f] = capsule[f * group + k];
      for (std::uint32_t d = 0; d < 3; ++d) {
        to.low[d] = box[d * group + k];
        to.high[d] = box[(3 + d) * group + k];
      }
    });
  }

  /// What the other members gathered comes behind what the first did, and then the parts, which are blocks
  /// from now on.
  void join() {
    SpaceTree::Gathered& all = space_.gathered[0];
    std::vector<std::size_t> begin;  // of each member's entries
    std::size_t entries = 0;
    for (const SpaceTree::Gathered& own : space_.gathered) {
      if (&own != &all)
        begin.push_back(entries), all.parts.insert(all.parts.end(), own.parts.begin(), own.parts.end());
      entries += own.entries.size();
    }
    all.entries.resize(entries);
    team_.for_each_range(team_.size() - 1, 1, [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t m = first; m < end; ++m) {
        const SpaceTree::Gathered& own = space_.gathered[m + 1];
        std::copy(own.entries.begin(), own.entries.end(), all.entries.begin() + begin[m]);
      }
    });
    add_parts();
  }

  void add_parts() {
    const auto parts = static_cast<std::uint32_t>(space_.parts().size());
    if (parts == 0) return;
    const std::size_t whole_blocks = space_.unsorted().size();
    space_.unsorted().resize(whole_blocks + parts);
    make_room_for_blocks(tree_, tree_.blocks + parts);
    constexpr std::uint32_t groups_of_a_task = 32;
    team_.for_each_range(
        (parts + group - 1) / group, groups_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t first = begin * group; first < std::min(parts, end * group); first += group) {
            const std::uint32_t count = std::min(group, parts - first);
            for (std::uint32_t k = first; k < first + count; ++k)
              set_block(tree_, tree_.blocks + k, space_.parts()[k].first, space_.parts()[k].size);
            add_parts(first, count, space_.unsorted().data() + whole_blocks + first);
          }
        });
  }
  void add_parts(std::uint32_t first, std::uint32_t count, SpaceTree::Unsorted* to) const {
    Sphere some[group * block];
    for (std::uint32_t k = 0; k < group; ++k)
      copy_block(chain_, tree_, tree_.blocks + first + std::min(k, count - 1), some + k * block);
    BlockSpheres spheres;
    load(some, Lanes16::all(tree_.unit()), spheres);
    Lanes16 reach;
    tell(spheres, capsules_around(spheres, reach), lane_bits(count),
         [&](std::uint32_t k) -> SpaceTree::Unsorted& {
           to[k].block = tree_.blocks + first + k;
           to[k].whole = space_.parts()[first + k].block;
           return to[k];
         });
  }

  void make_room(std::uint32_t n) {
    space_.entries = n;
    space_.block.resize(n), space_.whole.resize(n);
    space_.capsules.resize(std::size_t{space_.nodes()} * group * fields);
    std::size_t levels = 0;
    for (std::uint32_t count = n; count > 0; count = count > group ? (count + group - 1) / group : 0) {
      if (levels == space_.boxes.size()) space_.boxes.resize(levels + 1);
      space_.boxes[levels++].resize(std::size_t{(count + group - 1) / group} * group * box_fields);
    }
    space_.boxes.resize(levels);
  }

  /// Entry k in its place, or nothing past the last.
  void lay_out(std::uint32_t k) {
    constexpr float nowhere = std::numeric_limits<float>::infinity();
    const std::uint32_t n = space_.entries;
    const SpaceTree::Unsorted& entry = space_.unsorted()[space_.order[std::min(k, n - 1)]];
    if (k < n) space_.block[k] = entry.block, space_.whole[k] = entry.whole;
    std::memcpy(space_.capsules.data() + std::size_t{k} * fields, entry.capsule, sizeof entry.capsule);
    float* const box = space_.boxes_of(0, k / group) + k % group;
    for (std::uint32_t d = 0; d < 3; ++d) {
      box[d * group] = k < n ? entry.low[d] : nowhere;
      box[(3 + d) * group] = k < n ? entry.high[d] : -nowhere;
    }
  }

  /// Box k of level l, around sixteen of the level below.
  void enclose(std::size_t l, std::uint32_t k) {
    const auto count = static_cast<std::uint32_t>(space_.boxes[l - 1].size() / (group * box_fields));
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

  const ChainView& chain_;
  BlockTree& tree_;
  const Crowding& crowding_;
  SpaceTree& space_;
  const Team& team_;
  Vectors origin_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

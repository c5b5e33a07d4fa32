// From spheres to a SphereTree.
#if defined(CATENA_CORE_SPHERE_TREE_BUILD_SPHERE_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPHERE_TREE_BUILD_SPHERE_TREE_INL_H
#undef CATENA_CORE_SPHERE_TREE_BUILD_SPHERE_TREE_INL_H
#else
#define CATENA_CORE_SPHERE_TREE_BUILD_SPHERE_TREE_INL_H
#endif

#include <algorithm>
#include <limits>
#include <span>

#include "catena/core/blocks/transpose-inl.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/team.h"
#include "catena/core/prefetch.h"
#include "catena/core/space_tree/axis_boxes-inl.h"
#include "catena/core/sphere_tree/sphere_tree.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

class SphereBuild {
 public:
  SphereBuild(const ChainView& chain, SphereTree& tree, const Team& team)
      : chain_(chain), tree_(tree), team_(team) {}

  void run(std::span<const std::uint32_t> only, SpaceSort sort) {
    tree_.spheres = only.empty() ? chain_.size : static_cast<std::uint32_t>(only.size());
    if (sort == SpaceSort::anew || !kept(only)) {
      tree_.kept.forget();
      tree_.order.sort(chain_, only, team_);
      make_room();
      lay_out_all();
      tree_.kept.sorted(tree_.spheres, boxes());
      tree_.only.assign(only.begin(), only.end());
    }
    for (std::size_t l = 1; l < tree_.boxes.size(); ++l)
      for_each(tree_.count(l), [&](std::uint32_t k) { enclose(l, k); });
  }

 private:
  static constexpr std::uint32_t group = SphereTree::group, box_fields = SphereTree::box_fields;

  /// The order of the last tree serves these spheres, which are laid out by it then.
  bool kept(std::span<const std::uint32_t> only) {
    if (!std::ranges::equal(only, tree_.only) || !tree_.kept.may_serve(tree_.spheres)) return false;
    lay_out_all();
    return tree_.kept.serves(boxes());
  }
  BoxGroups boxes() const {
    return {tree_.boxes.empty() ? nullptr : tree_.boxes_of(0, 0), tree_.nodes(), chain_.extent.least_radius,
            chain_.extent.greatest_radius};
  }

  void lay_out_all() {
    for_each(tree_.nodes(), [&](std::uint32_t node) { lay_out(node); });
  }
  template <class Body>
  void for_each(std::uint32_t count, const Body& body) const {
    constexpr std::uint32_t nodes_of_a_task = 64 * group;
    team_.for_each_range((count + group - 1) / group, nodes_of_a_task / group,
                         [&](std::uint32_t begin, std::uint32_t end) {
                           for (std::uint32_t k = begin * group; k < end * group; ++k) body(k);
                         });
  }

  void make_room() {
    const std::uint32_t nodes = tree_.nodes();
    tree_.fields.resize(std::size_t{nodes} * group * SphereTree::sphere_fields);
    tree_.index.resize(std::size_t{nodes} * group);
    std::size_t levels = 0;
    for (std::uint32_t count = nodes; count > 0; count = count > group ? (count + group - 1) / group : 0) {
      if (levels == tree_.boxes.size()) tree_.boxes.resize(levels + 1);
      tree_.boxes[levels++].resize(std::size_t{(count + group - 1) / group} * group * box_fields);
    }
    tree_.boxes.resize(levels);
  }

  /// The spheres of a node and its box, as Box::around has it; past the last node a box that meets nothing.
  void lay_out(std::uint32_t node) {
    float* const box = tree_.boxes_of(0, node / group) + node % group;
    if (node >= tree_.nodes()) return put_nowhere(box);
    constexpr std::uint32_t ahead = 2 * group;
    const std::uint32_t first = node * group, last = tree_.spheres - 1;
    const Sphere* from[group];
    for (std::uint32_t k = 0; k < group; ++k) {
      if (first + k + ahead <= last) prefetch(chain_.spheres + tree_.order[first + k + ahead]);
      const std::uint32_t i = tree_.order[std::min(first + k, last)];
      from[k] = chain_.spheres + i;
      tree_.index[first + k] = i;
    }
    Lanes16 field[SphereTree::sphere_fields];  // x y z radius
    transpose_rows([&](std::size_t k) { return &from[k]->x; }, field);
    float* const to = tree_.fields_of(node);
    for (std::uint32_t f = 0; f < SphereTree::sphere_fields; ++f) field[f].store(to + f * group);
    Lanes16 radius = field[3], outward = Lanes16::all(0x1p-23f);
    for (std::uint32_t d = 0; d < 3; ++d) {
      Lanes16 low = field[d] - radius, high = field[d] + radius;
      box[d * group] = least(neg_mul_add(abs(low), outward, low));
      box[(3 + d) * group] = -least(neg_mul_add(abs(high), outward, Lanes16::all(0) - high));
    }
    for (std::uint32_t k = tree_.spheres - first; k < group; ++k)
      to[k] = std::numeric_limits<float>::quiet_NaN();
  }

  static HWY_INLINE float least(const Lanes16& v) {
    auto folded = v.part[0];
    for (std::size_t k = 1; k < Lanes16::parts; ++k) folded = hn::Min(folded, v.part[k]);
    return hn::GetLane(hn::MinOfLanes(Lanes16::Tag(), folded));
  }

  static void put_nowhere(float* box) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::uint32_t d = 0; d < 3; ++d) box[d * group] = infinity, box[(3 + d) * group] = -infinity;
  }

  /// Box k of level l, around those of the level below.
  void enclose(std::size_t l, std::uint32_t k) {
    float* const box = tree_.boxes_of(l, k / group) + k % group;
    if (k >= tree_.count(l)) return put_nowhere(box);
    for (std::uint32_t f = 0; f < box_fields; ++f) {
      const float* const of = tree_.boxes_of(l - 1, k) + f * group;
      box[f * group] = f < 3 ? *std::min_element(of, of + group) : *std::max_element(of, of + group);
    }
  }

  const ChainView& chain_;
  SphereTree& tree_;
  const Team& team_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#include "catena/core/sphere_tree/sphere_evidence.h"

namespace catena {
namespace {

constexpr std::uint32_t group = SphereTree::group;

}  // namespace

SphereNodes::SphereNodes(const SphereTree& tree, std::uint32_t first_id) : tree_(tree), first_of_{first_id} {
  for (std::size_t l = 0; l < tree.boxes.size(); ++l) first_of_.push_back(first_of_.back() + tree.count(l));
}

Box64 SphereNodes::bound(std::size_t level, std::uint32_t k) const {
  const float* const f = tree_.boxes_of(level, k / group) + k % group;
  return {{f[0], f[group], f[2 * group]}, {f[3 * group], f[4 * group], f[5 * group]}};
}

void SphereNodes::show(BoundsVisitor& visitor) const {
  visitor.tree({});
  for (std::size_t l = 1; l < tree_.boxes.size(); ++l)
    for (std::uint32_t k = 0; k < tree_.count(l - 1); ++k)
      visitor.edge(node(l, k / group), bound(l, k / group), node(l - 1, k), bound(l - 1, k));
  for (std::uint32_t place = 0; place < tree_.spheres; ++place)
    visitor.edge(node(0, place / group), bound(0, place / group), tree_.index[place], Everything{});
}

}  // namespace catena

#include "catena/core/blocks/block_evidence.h"

#include <array>
#include <cmath>
#include <span>

namespace catena {
namespace {

constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;

/// The part of a capsule's reach that its stored radius has for the rounding of tests alone: without it the
/// capsule encloses, and is apart from what a test finds it apart from.
constexpr double bare = 0x1p-20;  // 16 u

/// Capsule k of fields laid out sixteen at a time.
Capsule64 capsule(std::span<const float> fields, std::uint32_t k, double unit) {
  return shown_capsule(fields.data() + std::size_t{k / group} * group * BlockTree::capsule_fields + k % group,
                       group, unit);
}

/// Of the box of a node.
Vector64 centre(const BlockTree::Level& level, std::uint32_t node, double unit) {
  const float* const f = level.at(node) + node % group;
  return {f[0] * unit, f[group] * unit, f[2 * group] * unit};
}
std::array<Slab, 3> slabs(const BlockTree::Level& level, std::uint32_t node, double unit) {
  const float* const f = level.at(node) + node % group;
  std::array<Slab, 3> result;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const float* const axis = f + (3 + 3 * k) * group;
    const double half = f[(12 + k) * group] * unit;
    result[k] = {{axis[0], axis[group], axis[2 * group]}, -half, half};
  }
  return result;
}

}  // namespace

Capsule64 shown_capsule(const float* fields, std::uint32_t stride, double unit) {
  const auto at = [&](int field) { return double{fields[stride * static_cast<std::uint32_t>(field)]}; };
  const auto end = [&](double side) -> Vector64 {
    return {(at(0) + side * at(3)) * unit, (at(1) + side * at(4)) * unit, (at(2) + side * at(5)) * unit};
  };
  const double reach = std::hypot(at(3), at(4), at(5)) + at(6);
  return {end(-1), end(1), (at(6) - bare * reach) * unit};
}

std::uint32_t BlockEvidence::node_id(std::size_t level, std::uint32_t k) const {
  std::uint32_t id = block_id(tree_.blocks);
  for (std::size_t l = 0; l < level; ++l) id += tree_.level[l].count;
  return id + k;
}

void BlockEvidence::in_a_row(std::size_t l, std::uint32_t k) const {
  const std::uint32_t begin = k * group, end = begin + tree_.children_of(l, k);
  for (std::uint32_t a = begin; a < end; ++a)
    for (std::uint32_t b = a + 2; b < end; ++b) sink_.discarded(child_id(l, a), child_id(l, b));
}

void BlockEvidence::with_the_next(std::size_t l, std::uint32_t k) const {
  const std::uint32_t begin = k * group, next = begin + group, end = next + tree_.children_of(l, k + 1);
  for (std::uint32_t a = begin; a < next; ++a)
    for (std::uint32_t b = next; b < end; ++b)
      if (b > a + 1) sink_.discarded(child_id(l, a), child_id(l, b));
}

void BlockEvidence::ordered_inside(std::uint32_t b) const {
  const std::uint32_t begin = tree_.first[b];
  for (std::uint32_t i = begin; i < begin + block; ++i)
    for (std::uint32_t j = i + 1; j < begin + block; ++j) j == i + 1 ? compared(i, j) : sink_.discarded(i, j);
}

void BlockEvidence::ordered_between(std::uint32_t b) const {
  const std::uint32_t begin = tree_.first[b], next = begin + block;
  for (std::uint32_t i = begin; i < next; ++i)
    for (std::uint32_t j = next; j < next + block; ++j) j == i + 1 ? compared(i, j) : sink_.discarded(i, j);
}

void show_blocks(const ChainView& chain, const BlockTree& tree, BoundsVisitor& visitor) {
  if (tree.blocks == 0) return;
  struct Silent final : EvidenceSink {
    void discarded(std::uint32_t, std::uint32_t) override {}
    void tested(std::uint32_t, std::uint32_t) override {}
    void excluded(std::uint32_t, std::uint32_t) override {}
  } silent;
  const BlockEvidence ids(chain, tree, silent);
  const double unit = 1 / double{tree.scale};
  visitor.tree({.levels = static_cast<std::uint32_t>(tree.level.size()) + 2});
  for (std::size_t l = tree.level.size(); l-- > 0;)
    for (std::uint32_t k = 0; k < tree.level[l].count; ++k) {
      const auto sides = slabs(tree.level[l], k, unit);
      const Slabs64 around{centre(tree.level[l], k, unit), sides};
      const auto show_node = [&](std::uint32_t c, const Slabs64& parent) {
        const auto own_sides = slabs(tree.level[l - 1], c, unit);
        visitor.edge(ids.node_id(l, k), parent, ids.node_id(l - 1, c),
                     Slabs64{centre(tree.level[l - 1], c, unit), own_sides});
      };
      for (std::uint32_t c = k * group; c < k * group + tree.children_of(l, k); ++c)
        l == 0 ? visitor.edge(ids.node_id(0, k), around, ids.block_id(c), capsule(tree.capsules, c, unit))
               : show_node(c, around);
    }
  for (std::uint32_t b = 0; b < tree.blocks; ++b)
    for (std::uint32_t k = 0; k < block; ++k)
      if (const std::uint32_t i = tree.index(b, k); i != BlockTree::no_sphere)
        visitor.edge(ids.block_id(b), capsule(tree.capsules, b, unit), i, Everything{});
}

}  // namespace catena

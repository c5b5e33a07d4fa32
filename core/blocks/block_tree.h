#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// A tree over *blocks* of eight spheres, laid out for sixteen things a test. A block lies in a capsule;
/// sixteen blocks are a node, which lies in a box along axes of its own; sixteen nodes are a node of the next
/// level. A block holds eight consecutive spheres of one strand; the last of a strand, what is left.
///
/// Numbers are those of the chain times `scale`, a power of two, which brings the greatest to 2^19 .. 2^20:
/// no product overflows. What sums of lengths times numbers up to 1 lose by underflow is some 2^-146, less
/// than the `tiny` that every bound and test has on top; where squares and products of lengths would
/// underflow, other bounds are taken, or nothing is told apart.
struct BlockTree {
  static constexpr std::uint32_t block = 8;   ///< spheres of a block
  static constexpr std::uint32_t group = 16;  ///< blocks of a node, children of an inner node
  static constexpr std::uint32_t unfilled = 0x80000000u;

  /// Slack of capsules and tests, relative to the lengths they have to do with, and absolute.
  /// properties/proofs/ has what is needed of it.
  static constexpr float slack = 0x1p-19f;  // 32 u
  static constexpr float tiny = 0x1p-120f;
  /// Axes of an oriented box are orthonormal to within axes_error, computed; then it reaches axes_slack times
  /// the sum of its half sides farther than orthonormal axes would.
  static constexpr float axes_error = 0x1p-20f;  // 16 u
  static constexpr float axes_slack = 0x1p-17f;  // 128 u

  /// Fields of sixteen capsules: centre x y z, half axis x y z, radius, about 1 / |half axis|^2 (0 for a
  /// point).
  static constexpr std::uint32_t capsule_fields = 8;
  /// Fields of sixteen oriented boxes: centre x y z, three axes x y z, three half sides.
  static constexpr std::uint32_t oriented_fields = 15;

  struct Level {
    std::uint32_t count = 0;      ///< nodes
    LargeVector<float> oriented;  ///< their boxes, groups of sixteen
    /// Bit k of group g: along the longest axis of node 16 g + k its children follow one another, so that
    /// none meets the next but one, or a later one.
    LargeVector<std::uint16_t> in_a_row;
    /// The same of the node's children together with those of the next node of this level. Never set for the
    /// last of a group.
    LargeVector<std::uint16_t> with_the_next;
    const float* at(std::uint32_t k) const {
      return oriented.data() + std::size_t{k / group} * group * oriented_fields;
    }
    float* at(std::uint32_t k) { return oriented.data() + std::size_t{k / group} * group * oriented_fields; }
  };

  /// The children of node k of level l do not meet, but for those next to one another.
  bool in_a_row(std::size_t l, std::uint32_t k) const {
    return (level[l].in_a_row[k / group] >> k % group & 1) != 0;
  }
  /// No child of node k of level l meets one of node k + 1, but for the last of the one and the first of the
  /// other.
  bool with_the_next(std::size_t l, std::uint32_t k) const {
    return (level[l].with_the_next[k / group] >> k % group & 1) != 0;
  }

  /// Every pair is searched as if no node were in a row.
  void forget_rows() {
    for (Level& l : level) {
      l.in_a_row.assign(l.in_a_row.size(), 0);
      l.with_the_next.assign(l.with_the_next.size(), 0);
    }
  }
  /// Nodes of level 0 that are in a row.
  std::uint32_t rows() const {
    std::uint32_t count = 0;
    if (!level.empty())
      for (const std::uint16_t bits : level[0].in_a_row)
        count += static_cast<std::uint32_t>(std::popcount(bits));
    return count;
  }

  float scale = 1;
  /// The chain's spheres times `scale`, where squares of what lies between them leave binary32's range and no
  /// number loses a bit by that; else empty.
  LargeVector<Sphere> scaled;
  /// Binary32 tells of two spheres where it is right by so many times the slack that is proved; 1, or more.
  float doubt = 1;
  std::uint32_t blocks = 0;  ///< in the order of the chain
  /// [block]: the index of its first sphere, and `unfilled` where it has fewer than eight.
  LargeVector<std::uint32_t> first;
  LargeVector<std::uint8_t> filled;  ///< [block]: the spheres of one that is unfilled
  Sphere tail[2 * block];            ///< spheres from tail_first() on, and what no block has
  LargeVector<float> capsules;       ///< groups of sixteen
  /// Bit k of group g: in block 16 g + k and the next no two spheres collide that are not next to one
  /// another.
  LargeVector<std::uint16_t> ordered;

  std::vector<Level> level;  ///< nodes of sixteen blocks, in order; of sixteen nodes each; and so on to one

  static constexpr std::uint32_t no_sphere = 0xFFFFFFFFu;

  const float* capsules_of(std::uint32_t g) const {
    return capsules.data() + std::size_t{g} * group * capsule_fields;
  }
  float* capsules_of(std::uint32_t g) { return capsules.data() + std::size_t{g} * group * capsule_fields; }
  /// Of block b < blocks.
  float capsule_radius(std::uint32_t b) const { return capsules_of(b / group)[6 * group + b % group]; }
  std::uint32_t blocks_of(std::uint32_t g) const {
    const std::uint32_t left = blocks - g * group;
    return left < group ? left : group;
  }
  /// A block of node g for samples, at another place in each, so that no period of the chain's is met.
  std::uint32_t some_block_of(std::uint32_t g) const {
    return g * group + (g * 0x9E3779B1u >> 28) % blocks_of(g);
  }
  /// Children of node k of level l.
  std::uint32_t children_of(std::size_t l, std::uint32_t k) const {
    if (l == 0) return blocks_of(k);
    const std::uint32_t left = level[l - 1].count - k * group;
    return left < group ? left : group;
  }

  /// The spheres of a block.
  std::uint32_t size_of(std::uint32_t b) const { return first[b] & unfilled ? filled[b] : block; }
  std::uint32_t begin_of(std::uint32_t b) const { return first[b] & ~unfilled; }
  std::uint32_t end_of(std::uint32_t b) const { return begin_of(b) + size_of(b); }

  /// Those of the chain that are looked at, and what they are still to be times for the tree's lengths.
  const Sphere* spheres(const ChainView& chain) const {
    return scaled.empty() ? chain.spheres : scaled.data();
  }
  float unit() const { return scaled.empty() ? scale : 1; }
  /// Eight of them, of which the first size_of(b) are those of a block.
  const Sphere* spheres(const ChainView& chain, std::uint32_t b) const {
    const std::uint32_t i = begin_of(b);
    if ((first[b] & unfilled) == 0 || i + block <= chain.size) return spheres(chain) + i;
    return tail + (i - tail_first(chain.size));
  }
  /// The index of sphere k of a block, or no_sphere.
  std::uint32_t index(std::uint32_t b, std::uint32_t k) const {
    return k < size_of(b) ? begin_of(b) + k : no_sphere;
  }
  /// From here on eight spheres may be more than a chain of so many has.
  static std::uint32_t tail_first(std::uint32_t spheres) { return spheres < block ? 0 : spheres - block; }
};

}  // namespace catena

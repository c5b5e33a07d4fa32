#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// All that the exclusion rule asks about a sphere, but for extra pairs.
struct Place {
  SphereId id;
  Strand strand;
  double arc;
  float radius;
};

/// True when the rule alone makes two different spheres neighbours. The same comparisons as
/// ExclusionView::neighbours, on numbers of the whole chain.
bool neighbours(const Rule& rule, const Place& a, const Place& b);

/// Up to eight consecutive spheres of one piece: what ranks tell one another of.
struct Block {
  static constexpr std::uint32_t most = 8;
  std::uint32_t piece, begin, size;
};

/// A part made ready for search: as a chain of its own, cut into blocks, each in a box, with a tree over the
/// boxes. Blocks come in order of Morton codes, so that the tree is one of space however the chain runs.
class HeldPart {
 public:
  explicit HeldPart(Part part);
  /// Makes blocks and boxes; none are there before, as a rank that is alone needs none.
  void cut_blocks();

  /// The part's spheres as a chain whose strands are the pieces. It makes neighbours of none that are not;
  /// those that it misses are of different pieces of a strand, or around the end of a closed one that is not
  /// here whole.
  const Chain& chain() const { return chain_; }
  /// Whether it misses some.
  bool misses_neighbours() const { return misses_neighbours_; }

  const Rule& rule() const { return rule_; }
  std::span<const Piece> pieces() const { return pieces_; }
  std::span<const IdPair> extra() const { return extra_; }
  std::span<const Block> blocks() const { return blocks_; }
  const WideBoxTree& boxes() const { return boxes_; }
  std::span<const std::uint64_t> codes() const { return codes_; }  ///< of the blocks

  std::span<const Sphere> spheres(const Block& block) const {
    return chain_.spheres().subspan(block.begin, block.size);
  }
  /// Empty but under an arc window.
  std::span<const double> arcs(const Block& block) const;
  const Piece& piece(const Block& block) const { return pieces_[block.piece]; }
  SphereId id(const Block& block) const { return piece(block).first + (block.begin - piece(block).begin); }

  /// The number of a sphere of this part in the whole chain. O(1) but for pieces of less than eight spheres.
  SphereId id(std::uint32_t sphere) const { return place(sphere).id; }
  Place place(std::uint32_t sphere) const;
  /// By the rule, or as an extra pair. `a` is of this part.
  bool neighbours(const Place& a, const Place& b) const;

 private:
  bool look_for_missed() const;

  Rule rule_;
  std::vector<Piece> pieces_;
  Chain chain_;
  std::vector<IdPair> extra_;
  static constexpr std::uint32_t stride = 8;
  std::vector<std::uint32_t> piece_at_;  ///< [k]: of sphere stride * k
  std::vector<Block> blocks_;
  std::vector<std::uint64_t> codes_;
  WideBoxTree boxes_;
  bool misses_neighbours_;
};

/// A box around all these spheres, at least one.
Box box_around(std::span<const Sphere> spheres);

}  // namespace catena::ranks

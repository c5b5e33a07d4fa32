#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/ranks/block.h"
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

/// A part made ready for search: as a chain of its own, whose spheres are found by their numbers here.
class HeldPart {
 public:
  explicit HeldPart(Part part);

  /// The part's spheres as a chain. Its strands are the pieces, and it makes neighbours of none that are not;
  /// those that it misses are of different pieces of a strand, or around the end of a closed one that is not
  /// here whole. Or, as its search is quicker, it is one open strand that misses none, but passes over some:
  /// see for_each_passed.
  const Chain& chain() const { return chain_; }
  /// Whether it misses some.
  bool misses_neighbours() const { return misses_neighbours_; }
  /// visit(i, j) for every i < j that the chain alone makes neighbours: those near one another in two pieces.
  template <class Visit>
  void for_each_passed(const Visit& visit) const {
    if (!one_strand_) return;
    for (std::size_t p = 1; p < pieces_.size(); ++p) {
      const std::uint32_t begin = pieces_[p].begin, end = begin + pieces_[p].size;
      for (std::uint32_t i = begin - std::min(begin, rule_.window); i < begin; ++i)
        for (std::uint32_t j = begin; j < end && j - i <= rule_.window; ++j)
          if (!neighbours(place(i), place(j))) visit(i, j);
    }
  }

  const Rule& rule() const { return rule_; }
  std::span<const Piece> pieces() const { return pieces_; }
  /// Those of a part that is not needed any more, whose memory is given back with the rest of it.
  std::vector<Piece> release_pieces() && { return std::move(pieces_); }
  std::span<const IdPair> extra() const { return extra_; }

  std::span<const Sphere> spheres(const Block& block) const {
    return chain_.spheres().subspan(block.begin, block.size);
  }
  /// Empty but under an arc window.
  std::span<const double> arcs(const Block& block) const;
  const Piece& piece(const Block& block) const { return pieces_[block.piece]; }
  SphereId id(const Block& block) const { return piece(block).first + (block.begin - piece(block).begin); }

  /// The number of a sphere of this part in the whole chain. O(1) but for pieces of less than eight spheres.
  SphereId id(std::uint32_t sphere) const {
    const Piece& piece = piece_of(sphere);
    return piece.first + (sphere - piece.begin);
  }
  Place place(std::uint32_t sphere) const;
  /// False where the rule makes neighbours of no spheres that are so far apart in number, one of them of this
  /// part.
  bool may_be_neighbours(SphereId a, SphereId b) const {
    return (a < b ? b - a : a - b) <= furthest_neighbour_;
  }
  /// By the rule, or as an extra pair. `a` is of this part.
  bool neighbours(const Place& a, const Place& b) const;

 private:
  const Piece& piece_of(std::uint32_t sphere) const {
    std::uint32_t p = piece_at_.empty() ? 0 : piece_at_[sphere / stride];
    while (sphere - pieces_[p].begin >= pieces_[p].size) ++p;
    return pieces_[p];
  }
  bool look_for_missed() const;

  Rule rule_;
  std::vector<Piece> pieces_;
  bool one_strand_;
  Chain chain_;
  std::vector<IdPair> extra_;
  static constexpr std::uint32_t stride = 8;
  static constexpr std::size_t few = 8;  ///< pieces that are found without a table
  std::vector<std::uint32_t> piece_at_;  ///< [k]: of sphere stride * k
  bool misses_neighbours_;
  SphereId furthest_neighbour_;  ///< in number
};

}  // namespace catena::ranks

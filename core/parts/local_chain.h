#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/pair.h"
#include "catena/core/parts/part_ranges.h"
#include "catena/core/strategy/request.h"

namespace catena::parts {

/// The spheres of a part and of its halo as a chain of their own, in which exactly those that overlap are
/// neighbours that are so in the whole: first what is of parts before it, then its own spheres, then the
/// rest. A search for the pairs i < j whose i is of the part so finds each pair of the whole chain in one
/// part, and every collision of its own spheres.
class CATENA_API LocalChain {
 public:
  /// Consecutive spheres of one strand of the whole chain.
  struct Piece {
    std::uint32_t first;  ///< of the whole chain
    std::uint32_t begin;  ///< of this one
    std::uint32_t size;
    std::uint32_t strand;  ///< of the whole chain
    bool closed;           ///< all of a closed strand
  };

  /// How a search knows neighbours.
  enum class Neighbours {
    in_pieces,  ///< as strands, and extra pairs across these
    by_number   ///< by their numbers in the whole chain, where that is one open strand without extra pairs
  };
  /// O(ranges + size / 32 + p log p) for p pieces and those of their spheres that are neighbours across
  /// pieces, which are not looked for where numbers do. Throws CapacityError for 2^31 spheres or more.
  LocalChain(const Chain& whole, const PartRanges& part, Neighbours neighbours = Neighbours::in_pieces);

  std::uint32_t size() const { return begin_.back(); }
  SphereRange own() const { return own_; }
  /// Spheres of the whole chain, in the order of this one.
  std::span<const SphereRange> runs() const { return runs_; }
  /// Where in this one each run begins, and the last ends.
  std::span<const std::uint32_t> begins() const { return begin_; }
  /// [k]: the run of sphere stride * k. Empty where runs are few.
  std::span<const std::uint32_t> run_at() const { return run_at_; }
  static constexpr std::uint32_t stride = 32;
  /// Two spheres are neighbours as their numbers say; then there are neither pieces nor extra pairs.
  bool by_number() const { return by_number_; }
  /// Each is a strand.
  std::span<const Piece> pieces() const { return pieces_; }
  /// Neighbours that overlap and that no strand shows, i < j, each once, sorted.
  std::span<const Pair> extra() const { return extra_; }
  /// A single piece, open and without extra pairs: no table is needed to say who are neighbours.
  bool is_one_open_strand() const { return pieces_.size() == 1 && !pieces_[0].closed && extra_.empty(); }

  /// The number in the whole chain. O(1) where runs are not shorter than four spheres.
  std::uint32_t id(std::uint32_t local) const {
    std::uint32_t run = run_at_.empty() ? 0 : run_at_[local / stride];
    while (begin_[run + 1] <= local) ++run;
    return runs_[run].begin + (local - begin_[run]);
  }

 private:
  static constexpr std::size_t few = 8;  ///< runs that are found without a table
  void take(const std::vector<SphereRange>& ranges);
  void cut_pieces(const Chain& whole);

  bool by_number_;
  SphereRange own_;
  std::vector<SphereRange> runs_;
  std::vector<std::uint32_t> begin_{0};  ///< of each run, and the end
  std::vector<std::uint32_t> run_at_;    ///< [k]: of sphere stride * k
  std::vector<Piece> pieces_;
  std::vector<Pair> extra_;
};

}  // namespace catena::parts

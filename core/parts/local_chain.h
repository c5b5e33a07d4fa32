#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/pair.h"
#include "catena/core/parts/partition.h"
#include "catena/core/strategy/request.h"

namespace catena::parts {

/// The spheres of a part and of its halo as a chain of their own, in which exactly those are neighbours that
/// are so in the whole: first what is of parts before it, then its own spheres, then the rest. A search for
/// the pairs i < j whose i is of the part so finds each pair of the whole chain in one part, and every
/// collision of its own spheres.
class LocalChain {
 public:
  /// Consecutive spheres of one strand of the whole chain.
  struct Piece {
    std::uint32_t first;  ///< of the whole chain
    std::uint32_t begin;  ///< of this one
    std::uint32_t size;
    std::uint32_t strand;  ///< of the whole chain
    bool closed;           ///< all of a closed strand
  };

  /// O(groups + p log p) for p pieces and those of their spheres that are neighbours across pieces. Throws
  /// CapacityError for 2^31 spheres or more.
  LocalChain(const Chain& whole, const Partition& partition, std::uint32_t part);

  std::uint32_t size() const { return size_; }
  SphereRange own() const { return own_; }
  /// Spheres of the whole chain, in the order of this one.
  std::span<const SphereRange> runs() const { return runs_; }
  /// Each is a strand.
  std::span<const Piece> pieces() const { return pieces_; }
  /// Neighbours that no strand shows, i < j, each once, sorted.
  std::span<const Pair> extra() const { return extra_; }
  /// A single piece, open and without extra pairs: no table is needed to say who are neighbours.
  bool is_one_open_strand() const { return pieces_.size() == 1 && !pieces_[0].closed && extra_.empty(); }

  /// The number in the whole chain. O(1).
  std::uint32_t id(std::uint32_t local) const {
    // Behind the chain's last group, which may be short, groups begin earlier.
    const std::uint32_t padded = local < short_end_ ? local : local + missing_;
    return group_at_[padded / group_] * group_ + padded % group_;
  }

 private:
  void take_groups(const Chain& whole, const Partition& partition, std::uint32_t part);
  void cut_pieces(const Chain& whole);

  std::uint32_t group_, size_ = 0;
  SphereRange own_;
  std::vector<SphereRange> runs_;
  std::vector<Piece> pieces_;
  std::vector<Pair> extra_;
  std::vector<std::uint32_t> group_at_;
  std::uint32_t short_end_ = 0xFFFFFFFFu, missing_ = 0;
};

}  // namespace catena::parts

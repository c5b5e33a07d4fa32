#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// An exact search of a chain.
using FullSearch = std::function<void(const Chain&, const Request&, Collisions&)>;

/// The pairs of spheres that are near one another, kept over frames (a Verlet list). They are the answer of
/// an exact search of *thick* spheres, each by a skin larger: a frame of which every sphere lies within its
/// thick one has no other pairs. For two spheres a, b within A, B that overlap have A and B overlap; and who
/// is a neighbour depends on no radius under the rules that `can_keep` takes.
class CATENA_API KeptList {
 public:
  virtual ~KeptList() = default;

  /// Not under the arc-length rule, where thicker spheres have more neighbours.
  static bool can_keep(const Chain& chain);

  /// Makes the list of this chain. False, and there is no list, where a radius with its skin would not be
  /// finite or the thick spheres have more pairs than `most`.
  bool make(const Chain& chain, float skin, std::uint64_t most, const FullSearch& search);
  void drop() { made_ = false; }
  bool made() const { return made_; }
  float skin() const { return skin_; }
  std::size_t size() const { return sorted_.size(); }

  /// True only when each sphere lies within its thick one, for certain. O(n). Ask before every `find`.
  virtual bool holds(const Chain& chain) const;

  /// The colliding pairs of the spheres of a chain that it holds for, and of each sphere how many it has.
  void find(std::span<const Sphere> now, std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts) const;

 protected:
  const Chain& thick() const { return thick_; }

 private:
  void sort();

  Chain thick_;
  Collisions near_;                   ///< as they were found
  std::vector<Pair> sorted_;
  std::vector<std::size_t> begin_;  ///< of tiles, while they are sorted
  float skin_ = 0;
  bool made_ = false;
};

}  // namespace catena

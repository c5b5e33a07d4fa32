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
///
/// Of these the *inner* list are those that may come to collide or cease to while each sphere stays within an
/// inner skin of where and as large as it was when the list was pruned: of every other pair it is known
/// whether it collides (see part_pairs). It is pruned again, of all near pairs, when a sphere has left its
/// inner skin.
class CATENA_API KeptList {
 public:
  virtual ~KeptList() = default;

  /// Not under the arc-length rule, where thicker spheres have more neighbours.
  static bool can_keep(const Chain& chain);

  /// Makes the list of this chain. False, and there is no list, where a radius with its skin would not be
  /// finite or the thick spheres have more pairs than `most`. `inner_skin` is what the inner list is pruned
  /// for.
  bool make(const Chain& chain, float skin, float inner_skin, std::uint64_t most, const FullSearch& search);
  void drop() { made_ = false; }
  bool made() const { return made_; }
  float skin() const { return skin_; }
  std::size_t size() const { return near_.pairs.size(); }
  std::size_t inner_size() const { return inner_.size(); }  ///< as it was pruned last

  /// True only when each sphere lies within its thick one, for certain. O(n). Ask before every `find`.
  virtual bool holds(const Chain& chain) const;

  /// The colliding pairs of the spheres of a chain that it holds for, and of each sphere how many it has.
  /// `stand`: both are as the last find left them. True when the inner list had to be pruned again.
  bool find(std::span<const Sphere> now, std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts,
            bool stand);

 protected:
  const Chain& thick() const { return thick_; }
  /// Where the spheres were when the inner list was pruned.
  std::span<const Sphere> pruned_at() const { return pruned_at_; }
  /// True only when none has left its inner skin, for certain.
  virtual bool inner_holds(std::span<const Sphere> now) const;

 private:
  void prune(std::span<const Sphere> now);

  Chain thick_;
  Collisions near_;  ///< as the search found them, near one another in memory if they are in space
  float skin_ = 0, inner_skin_ = 0;
  bool made_ = false;
  bool pruned_ = false;
  std::vector<Sphere> pruned_at_;
  std::vector<Pair> settled_;                  ///< collide whatever moves within the inner skin
  std::vector<std::uint32_t> settled_counts_;  ///< of these
  std::vector<Pair> inner_;
};

}  // namespace catena

#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/frames/near_pairs.h"
#include "catena/core/frames/standing_pairs.h"
#include "catena/core/pair.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// An exact search of a chain.
using FullSearch = std::function<void(const Chain&, const Request&, Collisions&)>;

/// The pairs of spheres that are near one another, kept over frames (a Verlet list), and which of them
/// collide. They are the answer of an exact search of *thick* spheres, each by a skin larger: a frame of
/// which every sphere lies within its thick one has no other pairs. For two spheres a, b within A, B that
/// overlap have A and B overlap; and who is a neighbour depends on no radius under the rules that `can_keep`
/// takes.
///
/// Of these the *open* ones are those that may come to collide or cease to while each sphere stays within an
/// inner skin of where and as large as it was when the list was pruned: every other pair stays in the answer
/// or out of it unseen (see part_pairs). All near pairs are compared, and pruned again, when a sphere has
/// left its inner skin.
///
/// Spheres have *places*, in the order in which the search met them in pairs: where a frame's spheres stand
/// so, those of a pair are near one another in memory as they are in space.
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
  std::size_t size() const { return size_; }
  std::size_t open_size() const { return open_.size; }  ///< as it was pruned last

  /// True only when each sphere lies within its thick one, for certain. O(n). Ask before every `find`, but
  /// the one after `make`, with the same chain.
  virtual bool holds(const Chain& chain);

  /// The colliding pairs of the spheres of a chain that it holds for, and of each sphere how many it has.
  /// `stand`: both are as the last find left them, and what did not change is not written. True when the list
  /// had to be pruned again.
  bool find(std::span<const Sphere> now, std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts,
            bool stand);

 protected:
  const Chain& thick() const { return thick_; }
  /// True only when none of these spheres has left its inner skin, for certain. `before`: where they were
  /// when the list was pruned.
  virtual bool inner_holds(std::span<const Sphere> here, std::span<const Sphere> before) const;
  /// True only when each of these spheres lies within its thick one wherever it moves within its inner skin.
  virtual bool inner_within(std::span<const Sphere> now) const;
  /// By which open pairs are told from others, each of two spheres.
  virtual float open_skin() const { return inner_skin_; }

 private:
  void give_places();
  void look(std::span<const Sphere> now);

  Chain thick_;
  Collisions near_;       ///< as the search found them, then pairs of places: of no order in a pair
  std::size_t size_ = 0;  ///< of its pairs, behind which some are of no meaning
  float skin_ = 0, inner_skin_ = 0;
  bool made_ = false, pruned_ = false;
  bool covered_ = false;                  ///< what stays within its inner skin lies within its thick sphere
  bool looked_ = false;                   ///< here_ is of the next find
  bool inner_holds_ = false;              ///< then
  std::vector<std::uint32_t> place_of_;   ///< of each sphere
  LargeVector<std::uint32_t> sphere_at_;  ///< of each place
  LargeVector<Sphere> here_, pruned_at_;  ///< of each place
  std::vector<std::uint8_t> collide_;     ///< a bit a near pair
  OpenPairs open_;
  LargeVector<std::uint32_t> changed_;
  StandingPairs standing_;
};

}  // namespace catena

#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"

namespace catena::bench {

/// side^3 points of a lattice, spheres of radius reach / 2 about each, along the path of the scene
/// `serpentine`: what collides is known without a search, every contact at a whole distance being an exact
/// tie.
struct LatticeBox {
  using Cell = std::array<std::int64_t, 3>;  ///< numbers of a point along the axes of the box, from 0

  std::uint32_t side = 20;    ///< points along each axis; at most 1290 as a chain of one process
  std::uint32_t reach = 3;    ///< in steps of the coordinates
  bool face_centred = false;  ///< else cubic
  bool rods = false;          ///< each row a strand; else one strand, to and fro

  std::string scene() const;  ///< "serpentine:side=20,reach=3"
  std::uint64_t spheres() const { return std::uint64_t{side} * side * side; }

  /// Pairs that collide: half the sum, over all steps v between points that are 0 < |v| <= reach long, of the
  /// points that have another at v, less the neighbours. O(reach^3), in integers.
  std::uint64_t pairs() const;
  /// Those among them whose spheres touch and no more, neighbours left out.
  std::uint64_t ties() const;
  /// Collisions of the sphere in the middle of a box that is larger than twice its reach: the most of any.
  std::uint64_t most_collisions() const;

  Cell cell(std::uint64_t sphere) const;                    ///< where the path has this sphere
  std::int64_t square_of(const Cell& step) const;           ///< squared length of a step between points
  bool neighbours(std::uint64_t i, std::uint64_t j) const;  ///< consecutive on one strand
  bool collide(std::uint64_t i, std::uint64_t j) const;     ///< by whole numbers alone
};

/// What is wrong with an answer about the box, in one line; empty: nothing. With pairs it is right only when
/// every pair is one by whole numbers, none is there twice, and all together are as many as the closed form
/// says: so it is the whole set. With counts their sum decides, and the greatest.
std::string fault(const LatticeBox& box, const Collisions& found, bool with_pairs);

}  // namespace catena::bench

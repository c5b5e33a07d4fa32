#pragma once
#include <string>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// The spheres begin, ..., end - 1 of the scene serpentine, made by the rank that holds them: the same
/// numbers as in the whole scene. Coordinates are whole numbers below 2^24, as side < 2^23 gives.
Part lattice_part(const bench::LatticeBox& box, SphereId begin, SphereId end);

/// What is wrong with this rank's part of an answer about the box, in one line; empty: nothing. All ranks
/// call it: sums are over all of them.
std::string lattice_fault(Communicator& ranks, const bench::LatticeBox& box, const RankAnswer& answer,
                          bool with_pairs);

}  // namespace catena::ranks

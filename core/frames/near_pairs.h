#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena {

/// What a kept list does in vectors, compiled once for each instruction set.

/// True only when each sphere lies within the one of the same index for certain; see within.h.
bool all_within(std::span<const Sphere> now, std::span<const Sphere> thick);

/// A sphere by a skin thicker or thinner, rounded as here and nowhere else.
inline Sphere thicker(Sphere s, float skin) { return {s.x, s.y, s.z, s.radius + skin}; }
inline Sphere thinner(Sphere s, float skin) { return {s.x, s.y, s.z, s.radius - skin}; }

/// True only when each sphere for certain lies within the one before, by a skin thicker, and that one, by a
/// skin thinner, within it: its radius may have grown or shrunk.
bool all_near(std::span<const Sphere> now, std::span<const Sphere> before, float skin);

/// Parts pairs by what can become of them while all_near holds: fills `collide` with those whose thinner
/// spheres overlap for certain, for what contains them then overlaps; `open` with those of which neither that
/// nor that the thicker ones are separate is certain. No sphere of a pair that is left out can touch the
/// other.
void part_pairs(std::span<const Sphere> spheres, std::span<const Pair> pairs, float skin,
                std::vector<Pair>& collide, std::vector<Pair>& open);

/// Leaves in `found` the first `keep` that are there, followed by those of the pairs that collide, exactly.
void find_colliding(std::span<const Sphere> spheres, std::span<const Pair> pairs, std::size_t keep,
                    std::vector<Pair>& found);

}  // namespace catena

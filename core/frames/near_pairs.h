#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "catena/core/executor/large_vector.h"
#include "catena/core/export.h"
#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena {

// What a kept list does in vectors, compiled once for each instruction set.

/// A sphere by a skin thicker, its radius rounded as here and nowhere else.
inline Sphere thicker(Sphere s, float skin) { return {s.x, s.y, s.z, s.radius + skin}; }
/// The same by a skin thinner; its radius may be negative.
inline Sphere thinner(Sphere s, float skin) { return {s.x, s.y, s.z, s.radius - skin}; }

/// True only when each sphere, by a skin thicker, lies within the one of the same index for certain; see
/// within.h.
CATENA_API bool all_within(std::span<const Sphere> now, float skin, std::span<const Sphere> thick);

/// True only when each sphere for certain lies within the one before, by a skin thicker, and that one, by a
/// skin thinner, within it: its radius may have grown or shrunk.
CATENA_API bool all_near(std::span<const Sphere> now, std::span<const Sphere> before, float skin);

/// Pairs that are compared frame after frame.
struct OpenPairs {
  LargeVector<Pair> pairs;           ///< the first `size`, and room for eight more
  LargeVector<std::uint32_t> state;  ///< the same; 2 k + 1 where it collides and else 2 k: pair k of all
  std::size_t size = 0;
};

/// Compares all pairs, exactly; seven more may be read. Bit k % 8 of collide[k / 8] says whether pair k does,
/// and before whether it did; fills `changed` with those of which that is not the same. Fills `open` with the
/// pairs whose state may change while all_near holds. Of every other it is certain that the spheres by a skin
/// thinner overlap (a thinner radius may be negative where their sum is not: |cA - cB| <= tA + tB, |a - cA|
/// <= ra - tA and |b - cB| <= rb - tB give |a - b| <= ra + rb), or that those by a skin thicker are separate.
CATENA_API void part_pairs(std::span<const Sphere> spheres, std::span<const Pair> pairs, float skin,
                           std::span<std::uint8_t> collide, LargeVector<std::uint32_t>& changed,
                           OpenPairs& open);

/// Compares open pairs, exactly, and sets their states; fills `changed` with the k of those that changed.
void compare_open(std::span<const Sphere> spheres, OpenPairs& open, LargeVector<std::uint32_t>& changed);

}  // namespace catena

#pragma once
#include <cstdint>
#include <span>

#include "catena/core/export.h"
#include "catena/core/sphere.h"

namespace catena {

/// What rows of eight spheres that follow one another tell of a chain, about, by a look at some.
struct RowLook {
  /// Rows that one is near, but for those beside it: told by pairs of rows that meet, each of some with one at
  /// every distance along the chain, doubled from one to the next, and with more where each stands for many.
  /// So what is near along the chain and what is near by chance tell alike.
  double near = 0;
  /// From the first of a row to the last, of the way along it, of the middle one: a seventh or less where
  /// spheres that follow one another lie anywhere.
  double straight = 1;

  /// By as many rows as tell, most likely, whether they are near more than `asked` others; but by 24 at most.
  /// Each is of one strand, `strand_first` has where these begin and the last ends, or nothing for one; where
  /// a row is shorter, there are as many more. That of fewer than four rows is the default. O(log n).
  CATENA_API static RowLook at(std::span<const Sphere> spheres, double asked,
                               std::span<const std::uint32_t> strand_first = {});
};

}  // namespace catena

#pragma once
#include <optional>
#include <vector>

#include "catena/reference/bounds/exact.h"

/// Boxes and slabs as intersections of half-spaces, over integers. All functions are exact.
namespace catena::reference::exact {

/// All points p with normal . p <= reach. A normal of 0 is all points or, with reach < 0, none.
struct HalfSpace {
  Vector normal;
  Integer reach;
};
using HalfSpaces = std::vector<HalfSpace>;

/// The numbers by which a proper bound's place is given; directions and ends of slabs scale by themselves.
void fit(Unit& unit, const Box64& box);
void fit(Unit& unit, const Slabs64& slabs);

/// The proper bound, of points in `unit`: one half-space for each finite end. The unit must fit the bound.
HalfSpaces halfspaces(const Box64& box, const Unit& unit);
HalfSpaces halfspaces(const Slabs64& slabs, const Unit& unit);

/// True when the ball of that radius, >= 0, is in each.
bool contain(const HalfSpaces& all, const Vector& centre, const Integer& radius);

/// All points p such that a point of the segment from p to p + way is in each: a segment from p meets the
/// intersection, or is as far from it, as p does or is from this one. Fourier-Motzkin elimination: m
/// half-spaces become at most (m/2 + 1)^2.
HalfSpaces swept(const HalfSpaces& all, const Vector& way);

/// A point numerator / denominator, denominator > 0.
struct Point {
  Vector numerator;
  Integer denominator;
};

/// The point nearest to p that is in each; none when they have no point in common. Seidel's incremental
/// algorithm: O(m) steps on average over the order in which they are taken, which is shuffled.
std::optional<Point> nearest(HalfSpaces all, const Vector& p);

}  // namespace catena::reference::exact

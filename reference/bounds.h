#pragma once
#include "catena/core/hierarchy/bound.h"
#include "catena/core/sphere.h"

/// Exact tests of bounds of any kind. A bound is *proper* when no number in it is NaN, no radius is negative,
/// no interval is empty (low <= high, low < infinity, high > -infinity), no direction is 0, and nothing but
/// an infinite radius or the ends of an interval is infinite. An infinite radius makes everything of it, as
/// do slabs without a finite end. Of a bound that is not proper nothing is ever true: it contains and
/// encloses nothing, lies in nothing and is separate from nothing.
namespace catena::reference {

/// True when every point of the closed ball is in the bound, in exact arithmetic, no tolerance: exact for
/// every kind. A sphere that is not finite is in Everything and in infinite radii only. A clear case costs
/// about 10 ns (50 ns a slab), a near tie some microseconds.
bool contains(const AnyBound& bound, const Sphere64& sphere);
inline bool contains(const AnyBound& bound, const Sphere& s) {
  return contains(bound, Sphere64{s.x, s.y, s.z, s.radius});
}

/// True when no point is in both, for closed bounds: touching is not separate. In exact arithmetic, and exact
/// (if and only if) for proper bounds of any two kinds. Everything is never separate. Slabs that exclude each
/// other, which no point is in, are separate from every proper bound. Clear cases of spheres, capsules and
/// boxes cost up to 100 ns, as do slabs that one of their own directions separates; else exact integers
/// decide, from microseconds for boxes to a millisecond for a capsule and many slabs, more when the exponents
/// are far apart.
bool separate(const AnyBound& a, const AnyBound& b);

/// The same from integers alone, without estimates in binary64; what the estimates are tested against.
bool contains_by_integers(const AnyBound& bound, const Sphere64& sphere);
bool separate_by_integers(const AnyBound& a, const AnyBound& b);

/// True only when every point of the inner bound is in the outer one, in exact arithmetic. Exact (if and only
/// if) for Everything outside and for spheres, capsules and finite boxes inside, and for boxes in boxes.
/// Boxes with an infinite end are else found in Everything only. Slabs are found in slabs with the same
/// origin and directions (each slab of the outer must be among the inner's), and in Everything; elsewhere the
/// answer is false though they may be in.
bool encloses(const AnyBound& outer, const AnyBound& inner);

/// How far the sphere sticks out, over the size of the bound: its radius (sphere), radius and half length
/// (capsule), or largest finite half width (box, slabs); for messages, to about 2^-40. Negative or 0 exactly
/// when contained. Infinite when a number is not finite, a bound is not proper, or a bound of size 0 does not
/// contain it.
double shortfall(const AnyBound& bound, const Sphere64& sphere);
inline double shortfall(const AnyBound& bound, const Sphere& s) {
  return shortfall(bound, Sphere64{s.x, s.y, s.z, s.radius});
}

}  // namespace catena::reference

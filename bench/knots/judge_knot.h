#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "catena/bench/knots/first_contact.h"
#include "catena/bench/knots/polygon_shape.h"
#include "catena/bench/knots/published_knots.h"

namespace catena::bench {

/// Where the first contact of spheres about the vertices of a polygon may lie, for a published thickness T.
///
/// With h = e / 2T for the longest edge e, d = T (sqrt(1 + h^2) - 1), which is how far an arc of radius T
/// leaves a corner; c = atan(h) / h, the least share of its length that a polygon of bends >= T keeps when
/// its corners are rounded so; k = asin(h), half the angle of an arc of radius T above the edge.
///
/// Of the polygon, from above: a strut of 2T is perpendicular to the edges that it ends on, at s and t from
/// their first ends. Take an end of each edge at random, so that the mean of both steps is 0: the square of
/// their distance is 4T^2 + s (e - s) + t (e - t) in the mean, at most 4T^2 + e^2 / 2, and one of the four
/// pairs is no farther: the first contact is at most T sqrt(1 + h^2 / 2). (Along half a turn of radius T such
/// a pair are still neighbours; then the bend is T.) From below: vertices pi r or more apart along the
/// polygon, r < T, are nearest at a doubly critical pair, at least 2T, or where they are pi r apart; there
/// the rounded polygon, by Schur's theorem, is 2T sin(pi c r / 2T) wide, and its vertices are 2d nearer at
/// most. So they do not collide while r < T sin(pi c r / 2T) - d; the greatest r where that ends is the
/// lower bound. (Below about 2d the inequality says nothing either; what touches there is called a fault.)
///
/// Of a curve through the vertices, curved by at most 1/T. Its vertices meet no sooner than the tube itself:
/// T at least. From a strut's end the nearer vertex is at most kT along it, and leaves the tangent by
/// k^2 T / 2: T (sqrt(1 + k^2) + k^2 / 2) at most. Its length is between the polygon's and k / sin k times
/// that; a bend of the polygon is at least (shortest edge) / (2 tan k).
///
/// Of the type. The rounded polygon is no longer than the polygon and at most d thinner, so that the polygon
/// is at most d thicker than T, which is length / ropelength here; spheres see that as above:
/// T sqrt((1 + h^2) (1 + h^2 / 2)) at most. No lower bound.
///
/// Vertices that are known to within a blur move each of these by as much; so does the error of the number
/// printed.
struct KnotBounds {
  double thickness = 0;   ///< T, in units of the polygon
  double least = 0;       ///< of the first contact
  double most = 0;        ///< of it, or of the tightest bend where that is less
  double least_bend = 0;  ///< of the tightest bend
  double ropelength = 0;  ///< as told, or of the polygon with the thickness told
};

KnotBounds bounds_of(const PublishedKnot& published, const PolygonShape& shape, double blur);

/// A knot beside what was published of it.
struct KnotVerdict {
  PublishedKnot published;
  std::uint32_t vertices = 0;
  PolygonShape shape;
  KnotBounds bounds = {};
  std::optional<FirstContact> contact = {};  ///< nothing: none up to the greatest radius that was searched
  double searched_to = 0;                    ///< that radius
  std::uint64_t contacts = 0;                ///< pairs of spheres of the published thickness
  std::uint64_t contacts_at_most = 0;        ///< pairs at the radius where every strut must show

  double first() const;  ///< radius of the first contact, or how far it was searched for
  /// The lesser of first contact and tightest bend: what spheres make of the thickness.
  double thickness() const;
  double ropelength() const { return shape.length / thickness(); }
  /// A pair of vertices may stand for the struts of four pairs of edges.
  bool struts_show() const { return contacts_at_most * 4 >= published.struts; }
  bool within() const;
  std::string fault() const;  ///< what is not within, in words; empty: all is
};

/// Centres of closed strands, which are known to within `blur`. Throws like shape_of and the variant. Cost of
/// first_contact and two searches.
KnotVerdict judge_knot(Variant& variant, const PublishedKnot& published, const Chain& centres, double blur);

/// {knot, of, n, length, longest_edge, tightest_bend, published {ropelength, thickness}, first_contact {...},
/// ...}
nlohmann::ordered_json to_json(const KnotVerdict& verdict);

std::string words_of(PublishedKnot::Of of);  ///< "polygon", "curve", "type"

}  // namespace catena::bench

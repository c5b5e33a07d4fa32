#include "catena/bench/knots/judge_knot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catena/core/error.h"
#include "catena/core/rounded_up.h"

namespace catena::bench {
namespace {

/// f(h) / h for a function like h near 0, which edges far shorter than the tube is thick come to.
double share(double f, double h) { return h > 0 ? f / h : 1; }

/// The greatest x <= 1 with x = sin(pi c x / 2) - dip; 0 where there is none: edges too long to tell. The
/// right side is concave and below x at 1, so that the steps from 1 on fall to that x and never past it.
double least_share(double c, double dip) {
  double x = 1;
  for (;;) {
    const double next = std::sin(std::numbers::pi / 2 * c * x) - dip;
    if (next <= 0) return 0;
    if (!(next < x - 1e-15)) return next - 1e-12;
    x = next;
  }
}

struct Range {
  double low, high;
};

/// The thickness that is told, in units of the polygon, as far as the number is known.
Range told(const PublishedKnot& published, double length) {
  if (published.ropelength > 0)
    return {length / (published.ropelength + published.error),
            length / (published.ropelength - published.error)};
  return {published.thickness - published.error, published.thickness + published.error};
}

KnotBounds of_polygon(const Range& thickness, double edge) {
  const double h = edge / (2 * thickness.low), dip = std::sqrt(1 + h * h) - 1;
  return {.least = thickness.low * least_share(share(std::atan(h), h), dip),
          .most = thickness.high * std::sqrt(1 + h * h / 2),
          .least_bend = thickness.low};
}

KnotBounds of_curve(const Range& thickness, const PolygonShape& shape) {
  const double h = shape.longest_edge / (2 * thickness.low);
  if (h >= 1) return {.most = std::numeric_limits<double>::infinity()};
  const double k = std::asin(h), longer = share(k, h);
  return {.least = thickness.low,
          .most = thickness.high * longer * (std::sqrt(1 + k * k) + k * k / 2),
          .least_bend = shape.shortest_edge / (2 * std::tan(k))};
}

KnotBounds of_type(const Range& thickness, double edge) {
  const double h = edge / (2 * thickness.low);
  return {.most = thickness.high * std::sqrt((1 + h * h) * (1 + h * h / 2))};
}

}  // namespace

KnotBounds bounds_of(const PublishedKnot& published, const PolygonShape& shape, double blur) {
  const Range thickness = told(published, shape.length);
  // The blur of the ends of all edges is taken for the length's, too, which is shared out over the thickness.
  KnotBounds bounds = published.of == PublishedKnot::Of::polygon ? of_polygon(thickness, shape.longest_edge)
                      : published.of == PublishedKnot::Of::curve ? of_curve(thickness, shape)
                                                                 : of_type(thickness, shape.longest_edge);
  const double whole = 2 * blur / shape.shortest_edge;  // of any length along the polygon, as a share
  bounds.least = std::max(0.0, bounds.least * (1 - whole) - 2 * blur);
  bounds.most = bounds.most * (1 + whole) + 2 * blur;
  bounds.least_bend *= 1 - whole;
  bounds.thickness = (thickness.low + thickness.high) / 2;
  bounds.ropelength = published.ropelength > 0 ? published.ropelength : shape.length / published.thickness;
  return bounds;
}

double KnotVerdict::first() const { return contact ? double{contact->radius} : searched_to; }

double KnotVerdict::thickness() const { return std::min(first(), shape.tightest_bend); }

std::string KnotVerdict::fault() const {
  if (!contact && searched_to < shape.least_bend)
    return fmt::format("spheres up to a radius of {:.9g} do not touch", searched_to);
  if (contact && contact->radius < bounds.least)
    return fmt::format("spheres {} and {} touch at a radius of {:.9g}, below {:.9g}", contact->pair.i,
                       contact->pair.j, contact->radius, bounds.least);
  if (shape.greatest_bend < bounds.least_bend)
    return fmt::format("it bends to a radius of {:.9g}, below {:.9g}", shape.greatest_bend,
                       bounds.least_bend);
  if (std::min(first(), shape.least_bend) > bounds.most)
    return fmt::format("spheres up to a radius of {:.9g} fit in, above {:.9g}", thickness(), bounds.most);
  if (!struts_show())
    return fmt::format("{} contacts cannot be those of {} struts", contacts_at_most, published.struts);
  return "";
}

bool KnotVerdict::within() const { return fault().empty(); }

KnotVerdict judge_knot(Variant& variant, const PublishedKnot& published, const Chain& centres, double blur) {
  KnotVerdict v{.published = published, .vertices = centres.size(), .shape = shape_of(centres, blur)};
  const char* const too_thick = "the thickness told does not fit into binary32";
  if (!(told(published, v.shape.length).high <= std::numeric_limits<float>::max()))
    throw InputError(too_thick);
  v.bounds = bounds_of(published, v.shape, blur);
  if (!(v.bounds.thickness > 0 && std::isfinite(v.bounds.most)))
    throw InputError(fmt::format("edges as long as {:.6g} say nothing about a tube of radius {:.6g}",
                                 v.shape.longest_edge, v.bounds.thickness));
  if (!std::isfinite(static_cast<float>(2 * v.bounds.most))) throw InputError(too_thick);
  // Neighbours are among the pairs found, so that spheres larger than need be cost much. Twice what is
  // allowed, so that what is found beyond it can be told.
  for (double share = 0x1p-6; share <= 2 && !v.contact; share *= 2) {
    const float radius = rounded_up(share * v.bounds.most);
    v.searched_to = radius;
    v.contact = first_contact(variant, centres, radius);
  }
  v.contacts = contacts_at(variant, centres, static_cast<float>(v.bounds.thickness));
  const double strut = v.bounds.thickness * (1 + published.strut_tolerance);
  const double shows = std::hypot(strut, v.shape.longest_edge / std::sqrt(8));
  v.contacts_at_most = contacts_at(variant, centres, rounded_up(std::max(v.bounds.most, shows)));
  return v;
}

std::string words_of(PublishedKnot::Of of) {
  return of == PublishedKnot::Of::polygon ? "polygon" : of == PublishedKnot::Of::curve ? "curve" : "type";
}

nlohmann::ordered_json to_json(const KnotVerdict& v) {
  nlohmann::ordered_json line{{"knot", v.published.name},     {"of", words_of(v.published.of)},
                              {"source", v.published.source}, {"n", v.vertices},
                              {"length", v.shape.length},     {"longest_edge", v.shape.longest_edge}};
  if (std::isfinite(v.shape.tightest_bend)) line["tightest_bend"] = v.shape.tightest_bend;
  line["published"] = {{"ropelength", v.bounds.ropelength}, {"thickness", v.bounds.thickness}};
  if (v.published.struts > 0) line["published"]["struts"] = v.published.struts;
  if (v.contact) {
    line["first_contact"] = {{"radius", v.contact->radius}, {"pair", {v.contact->pair.i, v.contact->pair.j}}};
  }
  line["least"] = v.bounds.least;
  line["most"] = v.bounds.most;
  line["ropelength"] = v.ropelength();
  line["contacts"] = v.contacts;
  line["contacts_at_most"] = v.contacts_at_most;
  line["fault"] = v.fault();
  return line;
}

}  // namespace catena::bench

#include "catena/core/input/curve_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/chain/joints.h"
#include "catena/core/error.h"
#include "catena/core/periodic/unwrapped.h"

namespace catena {
namespace {

bool same_centre(const Sphere& a, const Sphere& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

void give_radii(CurveFile& curves, const InputOptions& options, const std::string& name) {
  const bool asked = options.radius.has_value() || options.radius_half_spacing;
  if (curves.has_radii && asked)
    throw InputError(fmt::format("{}: the file has radii of its own; leave out the radius", name));
  if (curves.has_radii || (options.centres_only && !asked)) return;
  if (!asked)
    throw InputError(
        fmt::format("{}: the file has no radii; give one with --radius R, or take half the median step "
                    "along the strands with --radius half-spacing",
                    name));
  if (options.radius && options.radius_half_spacing)
    throw InputError(fmt::format("{}: --radius and --radius half-spacing exclude each other", name));
  const double radius = options.radius ? double{*options.radius} : half_median_step(curves);
  if (options.radius && !(std::isfinite(radius) && radius >= 0))
    throw InputError(fmt::format("{}: the radius must be finite and not negative, got {}", name, radius));
  if (options.radius_half_spacing &&
      !(static_cast<float>(radius) > 0 && radius <= std::numeric_limits<float>::max()))
    throw InputError(fmt::format("{}: half the median step is {}, no usable radius; give one with --radius R",
                                 name, radius));
  const auto give = [&](std::vector<Sphere>& spheres) {
    for (Sphere& sphere : spheres) sphere.radius = static_cast<float>(radius);
  };
  give(curves.spheres);
  std::ranges::for_each(curves.later_frames, give);
}

// A closed curve whose file repeats the first point at the end would have that point twice, as spheres that
// are neighbours of each other but not of each other's neighbours.
void drop_repeated_ends(CurveFile& curves) {
  std::vector<std::uint32_t> kept, first{0};
  std::size_t dropped = 0;
  for (std::size_t s = 0; s + 1 < curves.strand_first.size(); ++s) {
    const std::uint32_t begin = curves.strand_first[s], end = curves.strand_first[s + 1];
    const auto repeats = [&](const std::vector<Sphere>& frame) {
      return same_centre(frame[begin], frame[end - 1]);
    };
    const bool drops =
        end - begin > 1 && repeats(curves.spheres) && std::ranges::all_of(curves.later_frames, repeats);
    dropped += drops;
    for (std::uint32_t i = begin; i < end - (drops ? 1 : 0); ++i) kept.push_back(i);
    first.push_back(static_cast<std::uint32_t>(kept.size()));
  }
  if (dropped == 0) return;
  curves.warnings.push_back(fmt::format("{} closed strand{} the first point at the end; it is taken once",
                                        dropped, dropped == 1 ? " repeats" : "s repeat"));
  curves.choose(kept);
  curves.strand_first = std::move(first);
}

void close_strands(CurveFile& curves, const std::string& name) {
  if (curves.is_tree || !curves.joints.empty())
    throw InputError(fmt::format("{}: a tree of branches has no closed strands; leave out --closed", name));
  std::ranges::fill(curves.strand_closed, std::uint8_t{1});
  // Where pairs name spheres by number, the numbers stay.
  if (curves.exclusion.extra_pairs.empty()) drop_repeated_ends(curves);
}

// Above this share of its radius a sphere's coordinates are said to have lost too much when they were
// rounded.
constexpr double greatest_share = 1e-3;

void warn_of_rounding(CurveFile& curves, bool own_radii) {
  const PointRounding& rounding = curves.rounding;
  if (const auto& origin = rounding.origin())
    curves.warnings.push_back(fmt::format("the origin {},{},{} is taken off every point", (*origin)[0],
                                          (*origin)[1], (*origin)[2]));
  double share = rounding.greatest_share();
  if (const double radius = curves.spheres.empty() ? 0 : curves.spheres[0].radius; !own_radii && radius > 0)
    share = rounding.greatest_error() / radius;
  if (share <= greatest_share) return;
  curves.warnings.push_back(
      fmt::format("binary32 rounds coordinates by up to {:.3g}, {:.3g} of a radius (said above {}){}",
                  rounding.greatest_error(), share, greatest_share,
                  rounding.origin() ? "" : "; --recentre takes an origin off before"));
}

/// Each point was finite; what is left of it may be no number of binary32.
void require_finite(const std::vector<Sphere>& spheres, const std::string& name) {
  for (std::size_t k = 0; k < spheres.size(); ++k)
    if (const Sphere& s = spheres[k]; !std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z))
      throw InputError(
          fmt::format("{}: sphere {} lies further than binary32 reaches from the origin that is taken off; "
                      "take another off with --origin X,Y,Z, or none",
                      name, k));
}

}  // namespace

double half_median_step(const CurveFile& curves) {
  std::vector<double> steps;
  const auto step = [&](std::size_t i, std::size_t j) {
    const Sphere &a = curves.spheres[i], &b = curves.spheres[j];
    steps.push_back(std::hypot(double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z));
  };
  for (std::size_t s = 0; s + 1 < curves.strand_first.size(); ++s) {
    const std::size_t first = curves.strand_first[s], last = curves.strand_first[s + 1];
    for (std::size_t i = first; i + 1 < last; ++i) step(i, i + 1);
    if (curves.strand_closed[s] && last - first > 2) step(last - 1, first);
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  if (steps.size() % 2 == 1) return *middle / 2;
  return (*middle + *std::max_element(steps.begin(), middle)) / 4;
}

Exclusion chosen_exclusion(const InputOptions& options, const Exclusion& own) {
  if (options.window && options.arc_window)
    throw InputError("an index window and an arc window exclude each other; give one of them");
  if (options.window && *options.window < 1) throw InputError("the index window must be at least 1");
  if (options.arc_window && !(std::isfinite(*options.arc_window) && *options.arc_window > 0))
    throw InputError(
        fmt::format("the arc window must be a finite number above 0, got {}", *options.arc_window));
  Exclusion chosen = own;
  if (options.window) chosen = Exclusion::index(*options.window);
  if (options.arc_window) chosen = Exclusion::arc(*options.arc_window);
  chosen.extra_pairs = own.extra_pairs;
  return chosen;
}

void complete(CurveFile& curves, const InputOptions& options, const std::string& name) {
  if (curves.rounding.origin()) {
    require_finite(curves.spheres, name);
    for (const auto& frame : curves.later_frames) require_finite(frame, name);
  }
  if (options.closed) close_strands(curves, name);
  const bool own_radii = curves.has_radii;
  give_radii(curves, options, name);
  warn_of_rounding(curves, own_radii);
}

Chain make_chain(CurveFile curves, const InputOptions& options) {
  Exclusion exclusion = chosen_exclusion(options, curves.exclusion);
  Strands strands{std::move(curves.strand_first), std::move(curves.strand_closed)};
  const bool cut_apart = !curves.boxes.empty() && exclusion.rule == Exclusion::Rule::arc_window;
  std::vector<Sphere> stored;
  if (cut_apart) {
    stored = curves.spheres;
    curves.spheres = unwrapped(stored, strands, curves.joints, curves.boxes[0]);
  }
  const auto across = pairs_across_joints(curves.spheres, strands, curves.joints, exclusion);
  exclusion.extra_pairs.insert(exclusion.extra_pairs.end(), across.begin(), across.end());
  const Chain chain(std::move(curves.spheres), std::move(strands), std::move(exclusion));
  return cut_apart ? chain.moved(std::move(stored)) : chain;
}

}  // namespace catena

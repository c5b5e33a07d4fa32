#include "catena/properties/counterexamples/failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catena/reference/enclosure.h"
#include "catena/reference/exact_gap.h"

namespace catena::properties {
namespace {

using Text = std::optional<std::string>;

/// Where a square lies among the numbers that the arithmetic has.
enum class Range { below, normal, above };
Range range_of(double square, const Format& format) {
  if (square < format.least_normal) return Range::below;
  return square > format.greatest ? Range::above : Range::normal;
}

double squared_distance(const Sphere64& a, const Sphere64& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  return dx * dx + dy * dy + dz * dz;
}

std::string in_words(const Sphere64& s) {
  const auto number = [](double v) { return std::isnan(v) ? "nan" : fmt::format("{:g}", v); };
  return fmt::format("({}, {}, {}; {})", number(s.x), number(s.y), number(s.z), number(s.radius));
}

bool same(const Sphere64& a, const Sphere64& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.radius == b.radius;
}

/// The first parent of two finite children for which `says` has something to say.
template <class Says>
Text some_parent(const Observed& seen, const Says& says) {
  for (const ParentSeen& p : seen.parents) {
    if (p.children.size() != 2 || !is_finite(p.children[0]) || !is_finite(p.children[1])) continue;
    if (Text text = says(p, squared_distance(p.children[0], p.children[1]))) return text;
  }
  return std::nullopt;
}

std::string children_of(const ParentSeen& p) { return fmt::format("nodes {} and {}", p.ids[0], p.ids[1]); }

/// The child that sticks out the most; nullopt when both are enclosed.
Text sticks_out(const ParentSeen& p) {
  std::size_t worst = 2;
  for (std::size_t k = 0; k < 2; ++k)
    if (!reference::encloses(p.parent, p.children[k]) &&
        (worst == 2 ||
         reference::shortfall(p.parent, p.children[k]) > reference::shortfall(p.parent, p.children[worst])))
      worst = k;
  if (worst == 2) return std::nullopt;
  return fmt::format("the parent of {} leaves node {} out by {:.3e} of its radius {:.3e}", children_of(p),
                     p.ids[worst], reference::shortfall(p.parent, p.children[worst]), p.parent.radius);
}

bool is_a_child(const ParentSeen& p) {
  return same(p.parent, p.children[0]) || same(p.parent, p.children[1]);
}

Text parent_does_not_enclose(const Observed& seen) {
  return some_parent(seen, [](const ParentSeen& p, double) -> Text {
    return is_finite(p.parent) && !is_a_child(p) ? sticks_out(p) : std::nullopt;
  });
}

Text child_returned_as_parent(const Observed& seen) {
  return some_parent(seen, [&](const ParentSeen& p, double squared) -> Text {
    return is_a_child(p) && range_of(squared, seen.format) == Range::normal ? sticks_out(p) : std::nullopt;
  });
}

Text equal_spheres_give_nan(const Observed& seen) {
  return some_parent(seen, [](const ParentSeen& p, double) -> Text {
    if (is_finite(p.parent) || !same(p.children[0], p.children[1])) return std::nullopt;
    return fmt::format("the parent of {} is {}", children_of(p), in_words(p.parent));
  });
}

Text parent_overflows(const Observed& seen) {
  return some_parent(seen, [&](const ParentSeen& p, double squared) -> Text {
    if (range_of(squared, seen.format) != Range::above || !sticks_out(p)) return std::nullopt;
    return fmt::format("the parent of {}, at a squared distance of {:.3e}, is {}", children_of(p), squared,
                       in_words(p.parent));
  });
}

Text parent_underflows(const Observed& seen) {
  return some_parent(seen, [&](const ParentSeen& p, double squared) -> Text {
    if (squared == 0 || 2 * squared > seen.format.least) return std::nullopt;
    if (is_finite(p.parent)) return sticks_out(p);
    return fmt::format("the parent of {}, at a squared distance of {:.3e}, is {}", children_of(p), squared,
                       in_words(p.parent));
  });
}

/// The first pair that `by_all_pairs` decides wrongly, missing or invented, whose t is in this range.
Text wrong_pair(const Observed& seen, bool missing, Range range) {
  const auto& found = seen.by_all_pairs.pairs;
  const auto& candidates = missing ? seen.exact.pairs : found;
  for (const Pair& pair : candidates) {
    if (std::ranges::binary_search(missing ? found : seen.exact.pairs, pair)) continue;
    const Sphere &a = seen.chain[pair.i], &b = seen.chain[pair.j];
    const double reach = double{a.radius} + b.radius;
    if (range_of(reach * reach, seen.format) != range) continue;
    const double margin = reference::margin(a, b);
    const std::string gap = margin == 0          ? "touch"
                            : std::isinf(margin) ? "are two points"
                                                 : fmt::format("{} by a margin of {:.3e}",
                                                               missing ? "collide" : "are apart", margin);
    return fmt::format("spheres {} and {} {}, and are found {}", pair.i, pair.j, gap,
                       missing ? "apart" : "colliding");
  }
  return std::nullopt;
}

Text lost_by_tree(const Observed& seen, bool finite) {
  if (seen.all_nodes_finite() != finite) return std::nullopt;
  for (const Pair& pair : seen.exact.pairs)
    if (seen.finds(seen.by_all_pairs, pair) && !seen.finds(seen.by_tree, pair))
      return fmt::format("spheres {} and {} collide, by a margin of {:.3e}, and the tree hides them", pair.i,
                         pair.j, reference::margin(seen.chain[pair.i], seen.chain[pair.j]));
  return std::nullopt;
}

Text found_from_one_side(const Observed& seen) {
  if (!seen.all_nodes_finite()) return std::nullopt;
  std::vector<std::uint32_t> count(seen.chain.size());
  for (const Pair& pair : seen.by_tree.pairs) ++count[pair.i], ++count[pair.j];
  for (std::uint32_t i = 0; i < seen.chain.size(); ++i)
    if (count[i] != seen.by_tree.count[i])
      return fmt::format("sphere {} is found to collide {} times, and its pairs are {}", i,
                         seen.by_tree.count[i], count[i]);
  return std::nullopt;
}

}  // namespace

const std::vector<Failure>& failures() {
  static const std::vector<Failure> all{
      {"parent-does-not-enclose", "a rounded centre or radius leaves a child out", parent_does_not_enclose},
      {"child-returned-as-parent", "one child is given for the parent although the other sticks out of it",
       child_returned_as_parent},
      {"equal-spheres-give-nan", "the parent of two equal spheres at one place is 0/0",
       equal_spheres_give_nan},
      {"parent-overflows", "the squared distance of two children overflows, and their parent is no sphere",
       parent_overflows},
      {"parent-underflows", "the squared distance of two children underflows to 0, and their parent is none",
       parent_underflows},
      {"pair-missed", "spheres that collide are decided apart",
       [](const Observed& seen) { return wrong_pair(seen, true, Range::normal); }},
      {"pair-invented", "spheres that are apart are decided colliding",
       [](const Observed& seen) { return wrong_pair(seen, false, Range::normal); }},
      {"underflow-misses", "(rA + rB)^2 underflows, and spheres that collide are decided apart",
       [](const Observed& seen) { return wrong_pair(seen, true, Range::below); }},
      {"underflow-invents", "the squares underflow, and spheres that are apart are decided colliding",
       [](const Observed& seen) { return wrong_pair(seen, false, Range::below); }},
      {"overflow-invents", "the squares overflow, and spheres that are apart are decided colliding",
       [](const Observed& seen) { return wrong_pair(seen, false, Range::above); }},
      {"pair-lost-by-tree",
       "a parent that does not enclose hides spheres that the same arithmetic finds colliding",
       [](const Observed& seen) { return lost_by_tree(seen, true); }},
      {"pair-lost-by-nan",
       "a parent that is not a number hides spheres that the same arithmetic finds colliding",
       [](const Observed& seen) { return lost_by_tree(seen, false); }},
      {"found-from-one-side", "sphere i finds sphere j, and j does not find i", found_from_one_side}};
  return all;
}

}  // namespace catena::properties

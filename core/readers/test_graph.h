#pragma once
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "catena/core/readers/reader.h"
#include "catena/core/readers/test_floats.h"

namespace catena {

/// Points that edges tie together, as a test writes them in a format, to hold what a reader gives against
/// them.
struct TestGraph {
  std::vector<Sphere> points;
  std::vector<Pair> edges;  ///< i < j, sorted, unique
};

/// Up to a dozen points, and any edges among them.
inline TestGraph any_graph() {
  TestGraph graph;
  for (auto left = *rc::gen::inRange(2, 13); left > 0; --left)
    graph.points.push_back({*any_finite(), *any_finite(), *any_finite(), std::abs(*any_finite())});
  const auto n = static_cast<std::uint32_t>(graph.points.size());
  for (auto left = *rc::gen::inRange(1, 16); left > 0; --left) {
    const auto i = *rc::gen::inRange<std::uint32_t>(0, n),
               j = (i + *rc::gen::inRange<std::uint32_t>(1, n)) % n;
    graph.edges.push_back({std::min(i, j), std::max(i, j)});
  }
  std::ranges::sort(graph.edges);
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  return graph;
}

/// The steps along the strands, those that close them, and the joints, as pairs of labels less `first_label`;
/// sorted.
inline std::vector<Pair> steps_of(const CurveFile& curves, std::uint32_t first_label) {
  const auto point = [&](std::uint32_t i) {
    return static_cast<std::uint32_t>(std::stoul(curves.labels.of(i))) - first_label;
  };
  std::vector<Pair> steps;
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    steps.push_back({std::min(point(i), point(j)), std::max(point(i), point(j))});
  };
  for (std::size_t s = 0; s < curves.strand_closed.size(); ++s) {
    const std::uint32_t first = curves.strand_first[s], last = curves.strand_first[s + 1];
    for (std::uint32_t i = first; i + 1 < last; ++i) add(i, i + 1);
    if (curves.strand_closed[s]) add(last - 1, first);
  }
  for (const Pair& joint : curves.joints) add(joint.i, joint.j);
  std::ranges::sort(steps);
  return steps;
}

/// That these curves are that graph: every point of an edge once, bit for bit, and every edge once; the
/// points without an edge too, where `with_free`.
inline void is_the_graph(const CurveFile& curves, const TestGraph& graph, std::uint32_t first_label,
                         bool with_radii, bool with_free) {
  std::set<std::uint32_t> due, found;
  for (const Pair& edge : graph.edges) due.insert(edge.i), due.insert(edge.j);
  for (std::uint32_t p = 0; with_free && p < graph.points.size(); ++p) due.insert(p);
  for (std::uint32_t i = 0; i < curves.spheres.size(); ++i) {
    const auto point = static_cast<std::uint32_t>(std::stoul(curves.labels.of(i))) - first_label;
    RC_ASSERT(point < graph.points.size());
    RC_ASSERT(found.insert(point).second);
    Sphere expected = graph.points[point];
    if (!with_radii) expected.radius = 0;
    RC_ASSERT((std::bit_cast<std::array<std::uint32_t, 4>>(curves.spheres[i]) ==
               std::bit_cast<std::array<std::uint32_t, 4>>(expected)));
  }
  RC_ASSERT(found == due);
  RC_ASSERT(curves.has_radii == with_radii);
  RC_ASSERT(steps_of(curves, first_label) == graph.edges);
  RC_ASSERT(curves.strand_first.back() == curves.spheres.size());
}

}  // namespace catena

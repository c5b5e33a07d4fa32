#include "catena/core/chain/joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "catena/core/chain/centre_distance.h"
#include "catena/core/default_floats.h"
#include "catena/core/error.h"

namespace catena {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

/// The tube as a graph, and the shortest ways in it (Dijkstra). For an index window every edge has the
/// length 1.
class TubeGraph {
 public:
  TubeGraph(std::span<const Sphere> spheres, const Strands& strands, std::span<const Pair> joints,
            const Exclusion& rule)
      : spheres_(spheres),
        rule_(rule),
        strand_of_(spheres.size()),
        along_(spheres.size(), 0),
        row_(spheres.size() + 1, 0),
        way_(spheres.size(), far) {
    std::vector<Pair> edges(joints.begin(), joints.end());
    const std::vector<std::uint32_t> one{0, static_cast<std::uint32_t>(spheres.size())};
    const auto& first = strands.first.empty() ? one : strands.first;
    for (std::uint32_t s = 0; s + 1 < first.size(); ++s) {
      for (std::uint32_t i = first[s]; i < first[s + 1]; ++i) strand_of_[i] = s;
      for (std::uint32_t i = first[s]; i + 1 < first[s + 1]; ++i) {
        edges.push_back({i, i + 1});
        along_[i + 1] = along_[i] + length(i, i + 1);
      }
      const bool closed = !strands.closed.empty() && strands.closed[s] != 0;
      const bool loop = closed && first[s + 1] - first[s] > 2;
      if (loop) edges.push_back({first[s], first[s + 1] - 1});
      loop_.push_back(loop ? along_[first[s + 1] - 1] + length(first[s], first[s + 1] - 1) : far);
    }
    for (const Pair& edge : edges) ++row_[edge.i + 1], ++row_[edge.j + 1];
    for (std::size_t i = 0; i < spheres.size(); ++i) row_[i + 1] += row_[i];
    edge_.resize(row_.back());
    auto next = row_;
    for (const Pair& edge : edges) {
      const double step = length(edge.i, edge.j);
      edge_[next[edge.i]++] = {edge.j, step};
      edge_[next[edge.j]++] = {edge.i, step};
    }
    // Shortest first, so that a search looks at no more of a sphere's many branches than it can enter.
    for (std::size_t i = 0; i < spheres.size(); ++i)
      std::ranges::sort(std::span(edge_).subspan(row_[i], row_[i + 1] - row_[i]), {}, &Edge::length);
  }

  bool by_index() const { return rule_.rule == Exclusion::Rule::index_window; }

  /// Whether that way is shorter than the one along a strand, and not only rounded differently.
  bool crosses_joint(std::uint32_t i, std::uint32_t j, double way) const {
    if (strand_of_[i] != strand_of_[j]) return true;
    const double ahead = std::abs(along_[i] - along_[j]);
    return way < std::min(ahead, loop_[strand_of_[i]] - ahead) * (1 - 1e-9);
  }

  /// Every pair is looked for from its end `i` of the larger radius, so that a huge soma is not searched for
  /// from every thin branch: then its way is shorter than this.
  double reach(std::uint32_t i) const {
    return by_index() ? rule_.window : 2 * rule_.factor * spheres_[i].radius;
  }
  bool found_from(std::uint32_t i, std::uint32_t j) const {
    return by_index() ? j < i : std::pair(spheres_[j].radius, j) < std::pair(spheres_[i].radius, i);
  }
  bool neighbours(std::uint32_t i, std::uint32_t j, double way) const {
    return by_index() ? way <= rule_.window
                      : way < rule_.factor * (double{spheres_[i].radius} + spheres_[j].radius);
  }

  /// Calls visit(j, way) for every sphere j no further than `limit` from the nearest source, in order of the
  /// way.
  template <class Visit>
  void search(std::span<const std::uint32_t> sources, double limit, const Visit& visit) {
    for (const std::uint32_t source : sources) reached(source, 0);
    while (!open_.empty()) {
      const auto [way, i] = open_.top();
      open_.pop();
      if (way > way_[i]) continue;  // it was reached on a shorter way later
      visit(i, way);
      for (std::size_t e = row_[i]; e < row_[i + 1] && way + edge_[e].length <= limit; ++e)
        reached(edge_[e].to, way + edge_[e].length);
    }
    for (const std::uint32_t i : touched_) way_[i] = far;
    touched_.clear();
  }

 private:
  struct Edge {
    std::uint32_t to;
    double length;
  };

  double length(std::uint32_t i, std::uint32_t j) const {
    return by_index() ? 1 : centre_distance(spheres_[i], spheres_[j]);
  }

  void reached(std::uint32_t i, double way) {
    if (!(way < way_[i])) return;
    if (way_[i] == far) touched_.push_back(i);
    way_[i] = way;
    open_.push({way, i});
  }

  using Open = std::pair<double, std::uint32_t>;
  std::span<const Sphere> spheres_;
  const Exclusion& rule_;
  std::vector<std::uint32_t> strand_of_;
  std::vector<double> along_;  ///< from the strand's first sphere
  std::vector<double> loop_;   ///< one a strand: its length around; far when it is open
  std::vector<std::size_t> row_;
  std::vector<Edge> edge_;
  std::vector<double> way_;  ///< of the search under way, far elsewhere
  std::vector<std::uint32_t> touched_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

}  // namespace

std::vector<Pair> pairs_across_joints(std::span<const Sphere> spheres, const Strands& strands,
                                      std::span<const Pair> joints, const Exclusion& rule) {
  if (joints.empty()) return {};
  const DefaultFloats floats;
  std::vector<std::uint32_t> ends;
  for (const Pair& joint : joints) {
    if (joint.i >= spheres.size() || joint.j >= spheres.size() || joint.i == joint.j)
      throw InputError(fmt::format("joint ({}, {}) does not name two of the {} spheres", joint.i, joint.j,
                                   spheres.size()));
    ends.push_back(joint.i);
    ends.push_back(joint.j);
  }
  TubeGraph graph(spheres, strands, joints, rule);

  // A way that is none of a strand leads over a joint, so only spheres with a joint within reach are searched
  // from. The slack covers that the same way, summed from its other end, may be rounded differently.
  constexpr double slack = 1.001;
  std::vector<std::uint32_t> near;
  graph.search(ends, far, [&](std::uint32_t i, double way) {
    if (way <= graph.reach(i) * slack) near.push_back(i);
  });
  std::vector<Pair> pairs;
  for (const std::uint32_t i : near)
    graph.search(std::span(&i, 1), graph.reach(i), [&](std::uint32_t j, double way) {
      if (graph.found_from(i, j) && graph.neighbours(i, j, way) && graph.crosses_joint(i, j, way))
        pairs.push_back({std::min(i, j), std::max(i, j)});
    });
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace catena

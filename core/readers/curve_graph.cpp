#include "catena/core/readers/curve_graph.h"

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/readers/in_order.h"

namespace catena {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

class CurveGraph {
 public:
  CurveGraph(std::uint32_t points, std::span<const Pair> edges) : row_(std::size_t{points} + 2, 0) {
    if (edges.size() >= (std::size_t{1} << 31)) throw InputError("more than 2^31 - 1 edges tie the points");
    for (const Pair& edge : edges)
      if (edge.i != edge.j) {
        ++row_[edge.i + 2], ++row_[edge.j + 2];
      } else {
        drawn_.resize(points);
        drawn_[edge.i] = true;
      }
    for (std::size_t p = 2; p < row_.size(); ++p) row_[p] += row_[p - 1];
    to_.resize(row_.back());
    // Each row begins one place late, and comes to its own begin as the row before it fills.
    for (const Pair& edge : edges)
      if (edge.i != edge.j) to_[row_[edge.i + 1]++] = edge.j, to_[row_[edge.j + 1]++] = edge.i;
  }

  std::span<const std::uint32_t> partners(std::uint32_t point) const {
    return std::span(to_).subspan(row_[point], row_[point + 1] - row_[point]);
  }

  /// Whether the point is of a line, or drawn alone.
  bool is_kept(std::uint32_t point) const { return degree(point) > 0 || (!drawn_.empty() && drawn_[point]); }

  /// An edge that is written twice does not make a branch.
  std::uint32_t degree(std::uint32_t point) const {
    const auto all = partners(point);
    if (all.size() < 2) return static_cast<std::uint32_t>(all.size());
    return std::ranges::all_of(all, [&](std::uint32_t other) { return other == all[0]; }) ? 1 : 2;
  }

 private:
  std::vector<std::uint32_t> row_;
  std::vector<std::uint32_t> to_;
  std::vector<bool> drawn_;  ///< points with an edge to themselves; empty: none has
};

class Strands {
 public:
  Strands(CurveFile& curves, const CurveGraph& graph)
      : curves_(curves), graph_(graph), place_(curves.spheres.size(), none) {}

  std::vector<std::uint32_t> lay_out(bool keep_free) {
    const auto points = static_cast<std::uint32_t>(place_.size());
    // Ends first, as a strand that starts in the middle of a line would cut it in two.
    for (std::uint32_t p = 0; p < points; ++p)
      if (graph_.degree(p) == 1) lay_out_from(p);
    for (std::uint32_t p = 0; p < points; ++p)
      if (keep_free || graph_.is_kept(p)) lay_out_from(p);
    tie();
    return std::move(order_);
  }

 private:
  // Side branches depth first, so that they lie near what they grow from; with a stack of our own, as they
  // can be deep.
  void lay_out_from(std::uint32_t point) {
    std::vector<std::uint32_t> starts{point};
    while (!starts.empty()) {
      const std::uint32_t start = starts.back();
      starts.pop_back();
      if (place_[start] != none) continue;
      const std::size_t begin = order_.size();
      for (std::uint32_t p = start; p != none; p = next_of(p)) {
        place_[p] = static_cast<std::uint32_t>(order_.size());
        order_.push_back(p);
      }
      for (std::size_t k = order_.size(); k-- > begin;)
        for (const std::uint32_t side : graph_.partners(order_[k]))
          if (place_[side] == none) starts.push_back(side);
      const auto closing = graph_.partners(order_.back());
      const bool closed = order_.size() - begin > 2 && std::ranges::find(closing, start) != closing.end();
      curves_.strand_first.push_back(static_cast<std::uint32_t>(order_.size()));
      curves_.strand_closed.push_back(closed ? 1 : 0);
    }
  }

  std::uint32_t next_of(std::uint32_t point) const {
    for (const std::uint32_t other : graph_.partners(point))
      if (place_[other] == none) return other;
    return none;
  }

  /// Every edge that is no step of a strand becomes a joint.
  void tie() {
    for (std::size_t s = 0; s + 1 < curves_.strand_first.size(); ++s) {
      const std::uint32_t first = curves_.strand_first[s], last = curves_.strand_first[s + 1] - 1;
      for (std::uint32_t i = first; i <= last; ++i)
        for (const std::uint32_t point : graph_.partners(order_[i])) {
          const std::uint32_t j = place_[point];
          const bool step = j == i + 1 && i < last;
          const bool closing = curves_.strand_closed[s] && i == first && j == last;
          if (j > i && !step && !closing) curves_.joints.push_back({i, j});
        }
    }
    std::ranges::sort(curves_.joints);
    curves_.joints.erase(std::unique(curves_.joints.begin(), curves_.joints.end()), curves_.joints.end());
  }

  CurveFile& curves_;
  const CurveGraph& graph_;
  std::vector<std::uint32_t> place_, order_;
};

}  // namespace

std::vector<std::uint32_t> arrange_along_edges(CurveFile& curves, std::span<const Pair> edges,
                                               bool keep_free) {
  std::vector<std::uint32_t> order;
  {
    const CurveGraph graph(static_cast<std::uint32_t>(curves.spheres.size()), edges);
    order = Strands(curves, graph).lay_out(keep_free);
  }
  put_in_order(curves.spheres, order);
  for (auto& frame : curves.later_frames) put_in_order(frame, order);
  return order;
}

}  // namespace catena

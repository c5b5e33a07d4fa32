#include "catena/core/chain/neighbour_reach.h"

#include <algorithm>

#include "catena/core/chain/topology.h"

namespace catena {
namespace {

constexpr std::uint32_t stride = 8;

/// One strand under an arc window. Arc lengths ascend and rounding is monotone, so that what is told of two
/// spheres holds of those between them, or beyond.
class ArcStrand {
 public:
  ArcStrand(const double* arc, std::uint32_t size, double loop_length)
      : arc_(arc), size_(size), loop_length_(loop_length) {}

  /// Spheres that lie less than `window` apart are no more steps apart than this, but around the end.
  std::uint32_t furthest(double window) const {
    std::uint32_t most = 0, beyond = 0;  // from there on all are too far from all of the stretch
    for (std::uint32_t begin = 0; begin < size_; begin += stride) {
      const double last = arc_[std::min(begin + stride, size_) - 1];
      beyond = std::max(beyond, begin + stride);
      while (beyond < size_ && arc_[beyond] - last < window) beyond += stride;
      most = std::max(most, std::min(beyond, size_) - 1 - begin);
    }
    return most;
  }
  /// Spheres no more steps apart lie less than `window` apart.
  std::uint32_t certain(double window) const {
    std::uint32_t least = NeighbourReach::any,
                  within = 0;  // up to there all are near enough to a stretch's first
    for (std::uint32_t begin = 0; begin < size_ && within + 1 < size_; begin += stride) {
      within = std::max(within, begin);
      if (!(arc_[within] - arc_[begin] < window)) return 0;
      while (within + 1 < size_ && arc_[std::min(within + stride, size_ - 1)] - arc_[begin] < window)
        within = std::min(within + stride, size_ - 1);
      if (within + 1 == size_) break;  // nothing beyond
      const std::uint32_t last = begin + stride - 1;
      least = std::min(least, within > last ? within - last : 0);
    }
    return least;
  }
  /// Those that lie less than `window` apart around the end are at least so many steps apart.
  std::uint32_t around(double window) const {
    const auto near = [&](double i, double j) { return loop_length_ - (j - i) < window; };
    // One must be near the last sphere, the other near the first, as nothing is nearer.
    const double first = arc_[0], last = arc_[size_ - 1];
    const auto count_until = [&](const auto& test) {
      return static_cast<std::uint32_t>(std::partition_point(arc_, arc_ + size_, test) - arc_);
    };
    const std::uint32_t end = count_until([&](double i) { return near(i, last); }),
                        begin = count_until([&](double j) { return !near(first, j); });
    if (end == 0 || begin == size_) return NeighbourReach::any;
    return begin >= end ? begin - (end - 1) : 0;
  }

 private:
  const double* arc_;
  const std::uint32_t size_;
  const double loop_length_;
};

NeighbourReach under_arc_window(const Topology& t, double least, double greatest) {
  NeighbourReach reach{NeighbourReach::any, 0, NeighbourReach::any};
  for (std::size_t s = 0; s < t.loop_length.size(); ++s) {
    const std::uint32_t first = t.strands.first[s], size = t.strands.first[s + 1] - first;
    if (size == 0) continue;
    const ArcStrand strand(t.arc.data() + first, size, t.loop_length[s]);
    reach.certain = std::min(reach.certain, strand.certain(least));
    reach.furthest = std::max(reach.furthest, strand.furthest(greatest));
    if (t.strands.closed[s] != 0) reach.around = std::min(reach.around, strand.around(greatest));
  }
  return reach;
}

NeighbourReach under_index_window(const Topology& t) {
  const std::uint32_t window = t.exclusion.window;
  NeighbourReach reach{window, window, NeighbourReach::any};
  for (std::size_t s = 0; s < t.strands.closed.size(); ++s)
    if (const std::uint32_t size = t.strands.first[s + 1] - t.strands.first[s];
        t.strands.closed[s] != 0 && size > 0)
      reach.around = std::min(reach.around, size - std::min(size, window));
  return reach;
}

}  // namespace

NeighbourReach neighbour_reach(const Topology& topology, float least_radius, float greatest_radius) {
  const auto window = [&](float radius) {
    return topology.exclusion.factor * (double{radius} + double{radius});
  };
  NeighbourReach reach = topology.exclusion.rule == Exclusion::Rule::arc_window
                             ? under_arc_window(topology, window(least_radius), window(greatest_radius))
                             : under_index_window(topology);
  if (!topology.exclusion.extra_pairs.empty()) reach.furthest = NeighbourReach::any;
  return reach;
}

}  // namespace catena

#include <algorithm>
#include <bit>
#include <compare>
#include <limits>
#include <span>
#include <vector>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/host_search.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// Sweep and prune (Cohen et al. 1995; the paper's reference [15]): boxes in order of where they begin on the
/// axis on which centres vary most, each held against those that begin before it ends. The order is kept from
/// frame to frame, so an update has little to sort. O(n log n) and, for each box, those that begin within it:
/// many where a chain is dense.
template <class Arithmetic>
class SweepAndPrune final : public HostSearch {
 public:
  Accounting evidence() const override { return Accounting::each_pair; }

  /// For evidence, the order as a tree of halves: all spheres of a node lie behind where its first box
  /// begins.
  void visit_bounds(BoundsVisitor& visitor) const override {
    const bool some = built() && size() > 0;
    visitor.tree({.levels = some ? static_cast<std::uint32_t>(std::bit_width(size() - 1)) + 1 : 0});
    if (some) show(visitor, all());
  }

 private:
  Plan steps() const override { return range_checks_plan<Arithmetic>(in_range_); }
  static constexpr std::uint32_t batch = 16;       ///< boxes compared without a branch
  static constexpr std::uint32_t most_shifts = 8;  ///< a box, beyond which an order is not worth mending

  struct Place {
    float begin;
    std::uint32_t id;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  /// Ends of all boxes on one axis, in order, then a batch of numbers that compare false.
  struct Ends {
    std::vector<float> low, high;
  };

  void construct(const ChainView& chain) override {
    sort(chain);
    lay_out(chain);
  }
  void construct_again(const ChainView& chain) override {
    if (first_ != axis_of_greatest_variance(chain) || !sort_again(chain)) sort(chain);
    lay_out(chain);
  }
  void search(const ChainView& chain, PairCollector& collector) override {
    with_tests(chain, [&]<class Tests>(Tests) {
      PairCollector::Lane& lane = collector.lane(0);
      for (std::uint32_t a = 0; a < size() && !lane.satisfied(); ++a) sweep<Tests>(a, chain, lane);
    });
  }
  void search_with_evidence(const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) override {
    with_tests(chain, [&]<class Tests>(Tests) {
      for (std::uint32_t a = 0; a < size(); ++a) sweep<Tests>(a, chain, lane, sink);
    });
  }
  template <class Work>
  void with_tests(const ChainView& chain, const Work& work) {
    in_range_ = in_range<Arithmetic>(chain);
    with_tests_for<Arithmetic>(chain, work);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }

  /// The axis and the order.
  void sort(const ChainView& chain) {
    first_ = axis_of_greatest_variance(chain);
    order_.resize(chain.size);
    for (std::uint32_t i = 0; i < chain.size; ++i) order_[i] = {begin_of(chain.spheres[i]), i};
    std::ranges::sort(order_);
  }

  /// By insertion; false when that takes too long.
  bool sort_again(const ChainView& chain) {
    std::uint64_t shifts = 0;
    for (std::uint32_t k = 0; k < size() && shifts <= std::uint64_t{most_shifts} * size(); ++k) {
      const Place place{begin_of(chain.spheres[order_[k].id]), order_[k].id};
      std::uint32_t to = k;
      for (; to > 0 && order_[to - 1] > place; --to) order_[to] = order_[to - 1];
      order_[to] = place;
      shifts += k - to;
    }
    return shifts <= std::uint64_t{most_shifts} * size();
  }

  void lay_out(const ChainView& chain) {
    for (Ends& ends : ends_)
      for (std::vector<float>* side : {&ends.low, &ends.high}) {
        side->resize(order_.size() + batch);
        std::fill(side->end() - batch, side->end(), std::numeric_limits<float>::quiet_NaN());
      }
    for (std::uint32_t k = 0; k < size(); ++k) {
      const Box box = Box::around(chain.spheres[order_[k].id]);
      for (int axis = 0; axis < 3; ++axis) {
        ends_[axis].low[k] = box.low[(first_ + axis) % 3];
        ends_[axis].high[k] = box.high[(first_ + axis) % 3];
      }
    }
  }

  float begin_of(const Sphere& s) const { return Box::around(s).low[first_]; }

  static int axis_of_greatest_variance(const ChainView& chain) {
    double sum[3] = {}, squares[3] = {}, variance[3];
    for (const Sphere& s : std::span(chain.spheres, chain.size)) {
      const double centre[] = {s.x, s.y, s.z};
      for (int axis = 0; axis < 3; ++axis)
        sum[axis] += centre[axis], squares[axis] += centre[axis] * centre[axis];
    }
    for (int axis = 0; axis < 3; ++axis) variance[axis] = squares[axis] - sum[axis] * sum[axis] / chain.size;
    return static_cast<int>(std::ranges::max_element(variance) - variance);
  }

  /// True when the boxes at a and b, a before b, overlap on all axes. On the first, b does not begin before
  /// a.
  bool meet(std::uint32_t a, std::uint32_t b) const {
    return (ends_[0].low[b] <= ends_[0].high[a]) & (ends_[1].low[b] <= ends_[1].high[a]) &
           (ends_[1].low[a] <= ends_[1].high[b]) & (ends_[2].low[b] <= ends_[2].high[a]) &
           (ends_[2].low[a] <= ends_[2].high[b]);
  }

  /// The box at a against those that begin within it.
  template <class Tests>
  void sweep(std::uint32_t a, const ChainView& chain, PairCollector::Lane& lane) const {
    const float end = ends_[0].high[a];
    for (std::uint32_t b = a + 1; ends_[0].low[b] <= end; b += batch) {
      std::int32_t met[batch], any = 0;
      for (std::uint32_t k = 0; k < batch; ++k) met[k] = meet(a, b + k);
      for (std::uint32_t k = 0; k < batch; ++k) any |= met[k];
      if (any == 0) continue;
      for (std::uint32_t k = 0; k < batch; ++k)
        if (met[k] != 0) spheres<Tests>(a, b + k, chain, lane);
    }
  }

  template <class Tests>
  void sweep(std::uint32_t a, const ChainView& chain, PairCollector::Lane& lane, EvidenceSink& sink) const {
    std::uint32_t b = a + 1;
    for (; ends_[0].low[b] <= ends_[0].high[a]; ++b) {
      const auto [i, j] = std::minmax(order_[a].id, order_[b].id);
      if (!meet(a, b)) {
        sink.discarded(i, j);
        continue;
      }
      chain.neighbours(i, j) ? sink.excluded(i, j) : sink.tested(i, j);
      spheres<Tests>(a, b, chain, lane);
    }
    discard_from(b, order_[a].id, all(), sink);
  }

  template <class Tests>
  void spheres(std::uint32_t a, std::uint32_t b, const ChainView& chain, PairCollector::Lane& lane) const {
    const auto [i, j] = std::minmax(order_[a].id, order_[b].id);
    if (Tests::overlap(Tests::bound(chain.spheres[i]), Tests::bound(chain.spheres[j])) &&
        !chain.neighbours(i, j))
      lane.collide(i, j);
  }

  /// A node of the tree of halves: positions begin, ..., end - 1; one of them is the sphere there.
  struct Half {
    std::uint32_t begin, end;
    std::uint32_t middle() const { return begin + (end - begin) / 2; }
    Half left() const { return {begin, middle()}; }
    Half right() const { return {middle(), end}; }
    bool is_sphere() const { return end - begin == 1; }
  };
  Half all() const { return {0, size()}; }
  std::uint32_t id(const Half& half) const {
    return half.is_sphere() ? order_[half.begin].id : size() + half.middle();
  }
  AnyBound bound(const Half& half) const {
    if (half.is_sphere()) return Everything{};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double low[] = {-infinity, -infinity, -infinity};
    low[first_] = order_[half.begin].begin;
    return Box64{{low[0], low[1], low[2]}, {infinity, infinity, infinity}};
  }

  void show(BoundsVisitor& visitor, const Half& half) const {
    if (half.is_sphere()) return;
    for (const Half& child : {half.left(), half.right()}) {
      visitor.edge(id(half), bound(half), id(child), bound(child));
      show(visitor, child);
    }
  }

  /// Discards, for the sphere of index i, what lies below `half` at `from` or after it.
  void discard_from(std::uint32_t from, std::uint32_t i, const Half& half, EvidenceSink& sink) const {
    if (half.end <= from) return;
    if (half.begin >= from) return sink.discarded(i, id(half));
    discard_from(from, i, half.left(), sink);
    discard_from(from, i, half.right(), sink);
  }

  int first_ = 0;  ///< the axis of the sweep
  std::vector<Place> order_;
  Ends ends_[3];           ///< of the axis of the sweep, then of the two after it
  bool in_range_ = false;  ///< of the last search
};

const RegisterVariant<SweepAndPrune, Robust> registered{
    {.name = "SweepAndPrune",
     .summary = "boxes sorted along one axis, the order kept between frames",
     .has_tree = true,
     .promises = {.same_bits = true}}};

}  // namespace
}  // namespace catena

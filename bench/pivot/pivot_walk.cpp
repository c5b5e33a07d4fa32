#include "catena/bench/pivot/pivot_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "catena/core/error.h"

namespace catena::bench {
namespace {

constexpr LatticeMove from_origin{
    {}, {-1, 0, 0}};  ///< so that the first point of the walk, one step on, is the origin
constexpr std::size_t most_levels = 32;

}  // namespace

/// The way from the root to the leaf that has the last point before the cut.
struct PivotWalk::Cut {
  std::uint32_t site;
  std::array<LatticeMove, most_levels> at;  ///< of the nodes on the way, the root's first
  std::size_t levels = 0;
  std::uint32_t leaf;
  LatticePoint centre;  ///< of the turn: the last point before the cut

  std::uint32_t node(std::size_t level) const { return leaf >> (levels - 1 - level); }
  bool goes_later(std::size_t level) const { return node(level + 1) % 2 == 1; }  ///< from this level down
};

PivotWalk::PivotWalk(std::uint32_t points) : size_(points) {
  if (points < 2 || points > 1u << 30)
    throw InputError(fmt::format("a walk has 2 to 2^30 points, not {}", points));
  while (std::uint64_t{leaves_} * most_in_leaf < points) leaves_ *= 2;
  near_.resize(points);
  for (std::uint32_t leaf = leaves_; leaf < 2 * leaves_; ++leaf)
    for (std::uint32_t p = first_point(leaf); p < first_point(leaf + 1); ++p)
      near_[p] = {static_cast<std::int8_t>(p - first_point(leaf) + 1), 0, 0};
  const auto straight = [](std::uint32_t steps) {
    return LatticePoint{static_cast<std::int32_t>(steps), 0, 0};
  };
  halves_.resize(leaves_);
  for (std::uint32_t node = 1; node < leaves_; ++node) {
    const std::uint32_t begin = first_below(2 * node), middle = first_below(2 * node + 1);
    const LatticePoint earlier_end = straight(middle - begin), later_end = straight(end_below(node) - middle);
    halves_[node] = {{straight(1), earlier_end}, {straight(1), later_end}, earlier_end, {}};
  }
  end_ = straight(points);
}

std::uint32_t PivotWalk::leaf_of(std::uint32_t point) const {
  auto leaf = leaves_ + static_cast<std::uint32_t>(std::uint64_t{point} * leaves_ / size_);
  while (first_point(leaf + 1) <= point) ++leaf;  // rounded down, it may be one too early
  return leaf;
}

/// The first point below a node.
std::uint32_t PivotWalk::first_below(std::uint32_t node) const {
  return first_point(node << (std::bit_width(leaves_) - std::bit_width(node)));
}

/// The first point beyond a node.
std::uint32_t PivotWalk::end_below(std::uint32_t node) const {
  return first_point((node + 1) << (std::bit_width(leaves_) - std::bit_width(node)));
}

LatticePoint PivotWalk::near(std::uint32_t point) const {
  const NearPoint& p = near_[point];
  return {p.x, p.y, p.z};
}

PivotWalk::Part PivotWalk::root() const { return {1, 0, size_, from_origin, {}}; }

PivotWalk::Part PivotWalk::half(std::uint32_t node, const LatticeMove& at, const LatticeBounds& box) const {
  if (is_leaf(node)) return {node, first_point(node), first_point(node + 1), at, at(box)};
  return {node, 0, 0, at, at(box)};
}

PivotWalk::Part PivotWalk::earlier(std::uint32_t node, const LatticeMove& at) const {
  return half(2 * node, at, halves_[node].earlier_box);
}

PivotWalk::Part PivotWalk::later(std::uint32_t node, const LatticeMove& at) const {
  return half(2 * node + 1, at_later(node, at), halves_[node].later_box);
}

/// Points begin .. end - 1 of a leaf, at least one.
PivotWalk::Part PivotWalk::some_of(std::uint32_t leaf, std::uint32_t begin, std::uint32_t end,
                                   const LatticeMove& at) const {
  LatticeBounds box = LatticeBounds::around(at(near(begin)));
  for (std::uint32_t p = begin + 1; p < end; ++p) box.join(LatticeBounds::around(at(near(p))));
  return {leaf, begin, end, at, box};
}

LatticeMove PivotWalk::at_later(std::uint32_t node, const LatticeMove& at) const {
  return {at.turn.after(halves_[node].later_turn), at(halves_[node].earlier_end)};
}

/// The last point of the later half, as it sees itself, from that of the node.
LatticePoint PivotWalk::later_end(std::uint32_t node, const LatticePoint& end) const {
  return halves_[node].later_turn.inverse()(end - halves_[node].earlier_end);
}

PivotWalk::Part PivotWalk::moved(const Part& part, const LatticeMove& move) const {
  return {part.node, part.begin, part.end, move.after(part.at), move(part.box)};
}

/// A point of one is a point of the other. What is nearest to where the two join is looked at first: a walk
/// that meets itself mostly does so there.
bool PivotWalk::meet(const Part& before, const Part& after) const {
  if (!before.box.meets(after.box)) return false;
  if (is_leaf(before.node) && is_leaf(after.node)) return points_meet(before, after);
  if (is_leaf(after.node) || (!is_leaf(before.node) && before.node <= after.node))
    return meet(later(before.node, before.at), after) || meet(earlier(before.node, before.at), after);
  return meet(before, earlier(after.node, after.at)) || meet(before, later(after.node, after.at));
}

bool PivotWalk::points_meet(const Part& before, const Part& after) const {
  std::array<LatticePoint, most_in_leaf> inside;
  std::size_t count = 0;
  for (std::uint32_t p = before.begin; p < before.end; ++p) {
    const LatticePoint at = before.at(near(p));
    if (after.box.meets(LatticeBounds::around(at))) inside[count++] = at;
  }
  if (count == 0) return false;
  for (std::uint32_t p = after.begin; p < after.end; ++p) {
    const LatticePoint at = after.at(near(p));
    for (std::size_t k = 0; k < count; ++k)
      if (inside[k] == at) return true;
  }
  return false;
}

PivotWalk::Cut PivotWalk::cut(std::uint32_t site) const {
  Cut cut;
  cut.site = site;
  cut.leaf = leaf_of(site);
  cut.levels = static_cast<std::size_t>(std::bit_width(leaves_));
  // The way is known from the site: its cache misses need not queue.
  for (std::size_t level = 0; level + 1 < cut.levels; ++level) __builtin_prefetch(&halves_[cut.node(level)]);
  cut.at[0] = from_origin;
  for (std::size_t level = 1; level < cut.levels; ++level)
    cut.at[level] =
        cut.goes_later(level - 1) ? at_later(cut.node(level - 1), cut.at[level - 1]) : cut.at[level - 1];
  cut.centre = cut.at[cut.levels - 1](near(site));
  return cut;
}

/// Turns everything after the cut about the last point before it.
void PivotWalk::turn(const Cut& cut, LatticeSymmetry turn) {
  const auto seen_from = [&](const LatticeMove& at) { return at.turn.inverse().after(turn).after(at.turn); };
  std::array<LatticePoint, most_levels> end;  // of the nodes on the way, as they are before the turn
  end[0] = end_;
  for (std::size_t level = 0; level + 1 < cut.levels; ++level) {
    const std::uint32_t node = cut.node(level);
    end[level + 1] = cut.goes_later(level) ? later_end(node, end[level]) : halves_[node].earlier_end;
  }

  const LatticeSymmetry in_leaf = seen_from(cut.at[cut.levels - 1]);
  const LatticePoint centre = near(cut.site);
  const std::uint32_t beyond_leaf = first_point(cut.leaf + 1);
  for (std::uint32_t p = cut.site + 1; p < beyond_leaf; ++p) {
    const LatticePoint turned = centre + in_leaf(near(p) - centre);
    near_[p] = {static_cast<std::int8_t>(turned.x), static_cast<std::int8_t>(turned.y),
                static_cast<std::int8_t>(turned.z)};
  }

  LatticeBounds box = some_of(cut.leaf, first_point(cut.leaf), beyond_leaf, {}).box;
  LatticePoint now = near(beyond_leaf - 1);
  for (std::size_t level = cut.levels - 1; level-- > 0;) {
    Halves& halves = halves_[cut.node(level)];
    LatticePoint of_later = now;
    if (cut.goes_later(level)) {
      halves.later_box = box;
    } else {  // the whole later half turns
      of_later = later_end(cut.node(level), end[level]);
      halves.later_turn = seen_from(cut.at[level]).after(halves.later_turn);
      halves.earlier_box = box, halves.earlier_end = now;
    }
    const LatticeMove to_later{halves.later_turn, halves.earlier_end};
    box = halves.earlier_box;
    box.join(to_later(halves.later_box));
    now = to_later(of_later);
  }
  end_ = now;
}

bool PivotWalk::attempt(const Pivot& pivot) {
  const Cut cut = this->cut(pivot.site);
  const LatticeMove about_centre{pivot.turn, cut.centre - pivot.turn(cut.centre)};
  const LatticeMove& at_leaf = cut.at[cut.levels - 1];
  before_.clear(), after_.clear();  // nearest to the pivot first
  before_.push_back(some_of(cut.leaf, first_point(cut.leaf), cut.site + 1, at_leaf));
  if (cut.site + 1 < first_point(cut.leaf + 1)) {
    after_.push_back(
        moved(some_of(cut.leaf, cut.site + 1, first_point(cut.leaf + 1), at_leaf), about_centre));
    if (meet(before_[0], after_[0])) return false;
  }
  // What each level adds, from the leaf up, against the other side so far.
  for (std::size_t level = cut.levels - 1; level-- > 0;) {
    const std::uint32_t node = cut.node(level);
    if (!cut.goes_later(level)) {
      after_.push_back(moved(later(node, cut.at[level]), about_centre));
      for (const Part& before : before_)
        if (meet(before, after_.back())) return false;
    } else {
      before_.push_back(earlier(node, cut.at[level]));
      for (const Part& after : after_)
        if (meet(before_.back(), after)) return false;
    }
  }
  turn(cut, pivot.turn);
  return true;
}

bool PivotWalk::attempt(std::span<const Pivot> pivots) {
  if (pivots.size() == 1) return attempt(pivots.front());
  for (const Pivot& pivot : pivots) turn(cut(pivot.site), pivot.turn);
  std::vector<Pivot> sorted(pivots.begin(), pivots.end());
  std::ranges::sort(sorted, {}, &Pivot::site);
  if (!meets_itself(root(), sorted)) return true;
  for (std::size_t k = pivots.size(); k-- > 0;) turn(cut(pivots[k].site), pivots[k].turn.inverse());
  return false;
}

/// Of these pivots, which lie between points of the part. A part without one is as it was, free of
/// collisions.
bool PivotWalk::meets_itself(const Part& whole, std::span<const Pivot> sorted) const {
  if (sorted.empty()) return false;
  if (is_leaf(whole.node)) {
    for (std::uint32_t p = whole.begin + 1; p < whole.end; ++p)
      for (std::uint32_t q = whole.begin; q < p; ++q)
        if (near(p) == near(q)) return true;
    return false;
  }
  const std::uint32_t middle = first_below(2 * whole.node + 1);
  const auto joining = std::ranges::lower_bound(sorted, middle - 1, {}, &Pivot::site);
  const auto beyond = std::ranges::lower_bound(sorted, middle, {}, &Pivot::site);
  const Part earlier_half = earlier(whole.node, whole.at), later_half = later(whole.node, whole.at);
  return meets_itself(earlier_half, {sorted.begin(), joining}) ||
         meets_itself(later_half, {beyond, sorted.end()}) || meet(earlier_half, later_half);
}

LatticePoint PivotWalk::end_to_end() const { return from_origin(end_); }

std::vector<LatticePoint> PivotWalk::points() const {
  std::vector<LatticePoint> points;
  points.reserve(size_);
  std::vector<Part> open{root()};
  while (!open.empty()) {
    const Part next = open.back();
    open.pop_back();
    if (is_leaf(next.node)) {
      for (std::uint32_t p = next.begin; p < next.end; ++p) points.push_back(next.at(near(p)));
    } else {
      open.push_back(later(next.node, next.at));
      open.push_back(earlier(next.node, next.at));
    }
  }
  return points;
}

Chain PivotWalk::chain(float radius) const {
  const auto exact = [](std::int32_t v) {
    if (std::abs(v) > 1 << 24)
      throw InputError(
          fmt::format("a coordinate of the walk is {}, beyond the whole numbers of binary32", v));
    return static_cast<float>(v);
  };
  std::vector<Sphere> spheres;
  spheres.reserve(size_);
  for (const LatticePoint& p : points()) spheres.push_back({exact(p.x), exact(p.y), exact(p.z), radius});
  return Chain(std::move(spheres));
}

}  // namespace catena::bench

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "catena/core/frames/frame_difference.h"
#include "catena/core/frames/frame_search.h"
#include "catena/core/strategy/timings.h"

// Which way a frame is searched: what it has in common with the last one, and what that saves.
namespace catena {
namespace {

constexpr std::size_t most_ranges = 1024;
constexpr double tree_sphere_ms = 6e-6;  // of the tree of runs, a sphere

/// How far a sphere moved and grew from one frame to the next, at most; about, for planning.
double greatest_move(std::span<const Sphere> before, std::span<const Sphere> now) {
  float square = 0, growth = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const float dx = now[i].x - before[i].x, dy = now[i].y - before[i].y, dz = now[i].z - before[i].z;
    square = std::max(square, dx * dx + dy * dy + dz * dz);
    growth = std::max(growth, now[i].radius - before[i].radius);
  }
  return std::sqrt(double{square}) + growth;
}

/// One that about as many spheres exceed as do not, by some of them; for planning.
float middling_radius(std::span<const Sphere> spheres) {
  std::array<float, 61> some{};  // a prime: no period of the chain hides what there is
  for (std::size_t k = 0; k < some.size(); ++k)
    some[k] = spheres[k * (spheres.size() - 1) / (some.size() - 1)].radius;
  std::ranges::nth_element(some, some.begin() + some.size() / 2);
  return some[some.size() / 2];
}

}  // namespace

FrameSearch::FrameSearch(const Omissions& omissions, bool always, std::unique_ptr<KeptList> list,
                         std::unique_ptr<MovedCells> cells)
    : omissions_(omissions), always_(always), row_(std::move(cells)), list_(std::move(list)) {
  ranges_.reserve(most_ranges);
}

bool FrameSearch::find_changes(std::span<const Sphere> before, std::span<const Sphere> now,
                               std::uint32_t most, std::vector<SphereRange>& ranges) const {
  return differing(before, now, most, ranges);
}

std::optional<std::int64_t> FrameSearch::find_shift(std::span<const Sphere> before,
                                                    std::span<const Sphere> now, std::uint32_t most,
                                                    std::int64_t guess) const {
  return shift_between(before, now, most, guess);
}

void FrameSearch::begin(bool follow) {
  forget();
  list_->drop();
  policy_.forget();
  looks_.begin(), lists_.begin();
  frames_ = follow || always_;
  behind_ = updated_ = crowded_ = in_vain_ = made_ = false;
  update_ms_ = beside_ms_ = plain_ms_ = 0;
  doubt_ = 0;
  shift_ = 0;
  way_ = Way::full;
}

void FrameSearch::passed() {
  if (!behind_) update_ms_ = 0;  // which the frame that was searched has been booked for
  behind_ = true;
  way_ = Way::full;
}

bool FrameSearch::can_shift(const Chain& chain) const {
  const ExclusionView rule = chain.view().exclusion;
  return rule.rule == Exclusion::Rule::index_window && rule.one_open_strand && rule.extra_row == nullptr;
}

/// The same spheres under the same rule, as far as update's caller can be wrong about it.
bool FrameSearch::comparable(const Chain& chain) const {
  if (!answered_ || chain.size() != row_.spheres().size()) return false;
  if (can_shift(chain)) return window_ == chain.exclusion().window;
  return topology_ == chain.view().topology;
}

FrameSearch::Way FrameSearch::update(const Chain& chain, const Moved& moved) {
  const Stopwatch watch;
  frames_ = updated_ = true;
  moved_ = 0;
  const bool known = comparable(chain);
  why_ = known ? Why::unlike : answered_ ? Why::another : crowded_ || in_vain_ ? Why::crowded : Why::not_kept;
  can_shift_ = can_shift(chain), can_keep_ = KeptList::can_keep(chain);
  if (!known) list_->drop();
  way_ = known ? choose(chain, moved) : Way::full;
  if (way_ == Way::full) forget();
  // A frame that is not searched costs what looking at it did.
  update_ms_ = watch.ms() + (behind_ ? update_ms_ : 0);
  behind_ = true;
  return way_;
}

/// The caller's ranges, where they are of the last frame that was searched.
bool FrameSearch::take(const Moved& moved, std::uint32_t n) {
  if (behind_ || moved.everything() || moved.ranges().size() > ranges_.capacity()) return false;
  ranges_.clear();
  for (const SphereRange& range : moved.ranges()) {
    const SphereRange inside = range.within(n);
    if (inside.size() > 0) ranges_.push_back(inside);
  }
  return true;
}

/// What searching so many runs that changed takes, by the tree or by cells; about. Frames of which some parts
/// move seldom come alone, so that a tree which does not stand yet is paid for by several.
double FrameSearch::least_ms(double runs) {
  const auto n = static_cast<double>(row_.spheres().size());
  // Not measured yet: some times what a full search takes for a run.
  const double run_ms = run_.measured ? run_.ms : 30 * policy_.full_ms() * RunTree::run / n;
  const double tree = runs * run_ms + (row_.tree_stands() ? 0 : tree_sphere_ms / 8 * n);
  const double cells = n * cell_sphere_.ms;
  by_cells_ = always_ ? !by_cells_ : cells < tree;
  return std::min(tree, cells);
}

FrameSearch::Way FrameSearch::choose(const Chain& chain, const Moved& moved) {
  const std::span<const Sphere> before = row_.spheres(), now = chain.spheres();
  // What a full search takes by now is worth knowing.
  constexpr unsigned much_doubt = 24;
  if (doubt_ >= much_doubt && !always_) return why_ = Why::doubt, Way::full;
  const auto most = static_cast<std::uint32_t>(always_ ? now.size() : now.size() / 4);
  if (const auto way = take_shift(moved, chain)) return *way;
  bool few = take(moved, chain.size());
  if (!few && (always_ || share_that_differs(before, now) < 0.5))
    few = find_changes(before, now, most, ranges_);
  if (few) {
    for (const SphereRange& range : ranges_) moved_ += range.size();
    if (ranges_.empty()) return omissions_.may(Omission::unmoved) ? Way::unmoved : Way::full;
    if (always_ && 2 * moved_ > now.size()) few = false;  // so that the other ways are gone too
  }
  if (few && omissions_.may(Omission::still_parts)) {
    const double runs =
        static_cast<double>(moved_) / RunTree::run + 2.0 * static_cast<double>(ranges_.size());
    // Frames of which some parts move seldom come alone.
    if (always_ || least_ms(runs) < 0.7 * policy_.full_ms()) return Way::parts;
  }
  if (const auto way = choose_shift(chain)) return *way;
  if (const auto way = choose_list(chain)) return *way;
  return Way::full;
}

/// The furthest of which the new end is searched alone.
std::int64_t FrameSearch::farthest_shift(const Chain& chain) const {
  if (!omissions_.may(Omission::shifted) || !can_shift(chain) || chain.size() < 2) return 0;
  return always_ ? chain.size() - 1 : chain.size() / 16;
}

FrameSearch::Way FrameSearch::go_shifted(std::int64_t s) {
  shift_ = s;
  least_ms(static_cast<double>(std::max(shift_, -shift_)) / RunTree::run + 2);
  // Shifts seldom come alone: what a run takes by the tree is worth knowing.
  if (!run_.measured && !always_) by_cells_ = false;
  return Way::shifted;
}

/// The caller's shift, where it is from the last frame that was searched.
std::optional<FrameSearch::Way> FrameSearch::take_shift(const Moved& moved, const Chain& chain) {
  const std::int64_t s = moved.shift(), most = farthest_shift(chain);
  if (behind_ || s == 0 || s > most || s < -most) return std::nullopt;
  return go_shifted(s);
}

std::optional<FrameSearch::Way> FrameSearch::choose_shift(const Chain& chain) {
  const std::int64_t most = farthest_shift(chain);
  if (most == 0) return std::nullopt;
  const auto s = find_shift(row_.spheres(), chain.spheres(), static_cast<std::uint32_t>(most), shift_);
  if (!s) return std::nullopt;
  return go_shifted(*s);
}

std::optional<FrameSearch::Way> FrameSearch::choose_list(const Chain& chain) {
  if (!omissions_.may(Omission::far_pairs) || !KeptList::can_keep(chain)) return std::nullopt;
  if (policy_.cold() && !always_) return std::nullopt;
  if (list_->made()) {
    const bool pays = always_ || policy_.use_pays();
    const Stopwatch watch;
    const bool holds = pays && list_->holds(chain);
    holds_ms_ = watch.ms();
    if (holds) return Way::kept_list;
    if (pays) policy_.ended();
    list_->drop();
  }
  if (!always_ && !lists_.may_try()) return std::nullopt;
  move_ = greatest_move(row_.spheres(), chain.spheres());
  const double thickest = chain.view().extent.greatest_radius;
  // A skin that is thick beside most spheres would make a list of very many pairs, however thick the rest is.
  radius_ = always_ ? thickest : middling_radius(chain.spheres());
  policy_.expect(chain.size());
  constexpr double life_in_tests = 3;
  skin_ = std::max(always_ ? move_ * life_in_tests : policy_.skin_for(move_, radius_), thickest * 0x1p-10);
  constexpr double inner_life = 4;  // frames at least; steps by chance part as the root of their number
  inner_skin_ = std::min(inner_life * move_, skin_ / 2);
  const bool sensible = std::isfinite(skin_) && skin_ > 0 && skin_ < 1e30;
  if (sensible && (always_ || (skin_ <= radius_ && policy_.pays(skin_, move_, radius_))))
    return Way::kept_list;
  return std::nullopt;
}

}  // namespace catena

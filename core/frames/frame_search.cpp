#include "catena/core/frames/frame_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/frames/frame_difference.h"
#include "catena/core/strategy/timings.h"

namespace catena {
namespace {

constexpr std::size_t most_ranges = 1024;
constexpr std::uint64_t most_own_pairs = std::uint64_t{1} << 26;  // half a GiB
constexpr double tree_sphere_ms = 6e-6;                           // of the tree of runs, a sphere
constexpr std::uint32_t longest_wait = 64;

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

/// From the latest measurement; the first one replaces what was guessed.
void learn(FrameSearch::Learned& figure, double latest) {
  figure.ms = figure.measured ? 0.7 * figure.ms + 0.3 * latest : latest;
  figure.measured = true;
}

/// Frames to wait after the nth time in a row that something did not pay.
std::uint32_t wait_after(std::uint32_t times) { return std::min(longest_wait, 2u << std::min(times, 8u)); }

}  // namespace

FrameSearch::FrameSearch(const Omissions& omissions, bool always, std::unique_ptr<KeptList> list)
    : omissions_(omissions), always_(always), list_(std::move(list)) {
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
  frames_ = follow || always_;
  behind_ = updated_ = false;
  blind_ = blinds_ = wait_ = waits_ = 0;
  shift_ = 0;
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
  frames_ = updated_ = true;
  moved_ = 0;
  const bool known = comparable(chain);
  if (!known) list_->drop();
  way_ = known ? choose(chain, moved) : Way::full;
  if (way_ == Way::full) forget();
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
  const auto most = static_cast<std::uint32_t>(always_ ? now.size() : now.size() / 4);
  if (const auto way = take_shift(moved, chain)) return blinds_ = 0, *way;
  bool few = take(moved, chain.size());
  if (!few && (always_ || share_that_differs(before, now) < 0.5))
    few = find_changes(before, now, most, ranges_);
  if (few) {
    for (const SphereRange& range : ranges_) moved_ += range.size();
    if (ranges_.empty()) return blinds_ = 0, omissions_.may(Omission::unmoved) ? Way::unmoved : Way::full;
    if (always_ && 2 * moved_ > now.size()) few = false;  // so that the other ways are gone too
  }
  if (few && omissions_.may(Omission::still_parts)) {
    const double runs =
        static_cast<double>(moved_) / RunTree::run + 2.0 * static_cast<double>(ranges_.size());
    // Frames of which some parts move seldom come alone.
    if (always_ || least_ms(runs) < 0.7 * policy_.full_ms()) return blinds_ = 0, Way::parts;
  }
  if (const auto way = choose_shift(chain)) return blinds_ = 0, *way;
  if (const auto way = choose_list(chain)) return blinds_ = 0, *way;
  blind_ = wait_after(blinds_++);
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
  if (list_->made()) {
    const bool pays = always_ || policy_.use_pays();
    if (pays) waits_ = 0;
    if (pays && list_->holds(chain)) return Way::kept_list;
    list_->drop();
    if (!pays) wait_ = wait_after(waits_++);
  }
  if (wait_ > 0 && !always_) return --wait_, std::nullopt;
  move_ = greatest_move(row_.spheres(), chain.spheres());
  const double thickest = chain.view().extent.greatest_radius;
  constexpr double life_in_tests = 3;
  skin_ = std::max(move_ * (always_ ? life_in_tests : policy_.life()) * 1.05, thickest * 0x1p-10);
  const bool sensible = std::isfinite(skin_) && skin_ > 0 && skin_ < 1e30;
  if (sensible && (always_ || (skin_ <= thickest && policy_.pays()))) return Way::kept_list;
  wait_ = wait_after(waits_++);
  return std::nullopt;
}

/// pairs_ are those of this chain.
void FrameSearch::remember(const Chain& chain) {
  counts_stand_ = false;
  counts_.reserve(chain.size());
  row_.hold(chain.spheres());
  topology_ = chain.view().topology;
  window_ = can_shift(chain) ? chain.exclusion().window : 0;
  answered_ = true;
}

void FrameSearch::search_all(const Chain& chain, const Request& request, Collisions& result,
                             const FullSearch& here) {
  const bool worth = frames_ && request.want != Request::Want::any && blind_ == 0;
  if (blind_ > 0) --blind_;
  const bool all = request.want == Request::Want::pairs &&
                   request.queries.within(chain.size()) == SphereRange{0, chain.size()};
  if (!worth) {
    here(chain, request, result);
  } else if (all) {
    here(chain, request, result);
    pairs_.assign(result.pairs.begin(), result.pairs.end());
    remember(chain);
  } else {
    Request everything;
    everything.pair_limit = most_own_pairs;
    try {
      here(chain, everything, own_);
    } catch (const PairLimitExceeded&) {
      return here(chain, request, result);
    }
    std::swap(pairs_, own_.pairs);
    remember(chain);
    report(chain, request, result);
  }
}

void FrameSearch::search_by_list(const Chain& chain, const FullSearch& search) {
  const bool fresh = !list_->made();
  if (fresh) {
    const Stopwatch watch;
    list_->make(chain, static_cast<float>(skin_), most_own_pairs, search);
    policy_.rebuilt(watch.ms(), move_);
  }
  if (!list_->made()) {
    wait_ = wait_after(waits_++);
    Request everything;
    everything.pair_limit = most_own_pairs;
    search(chain, everything, own_);
    std::swap(pairs_, own_.pairs);
    return remember(chain);
  }
  const Stopwatch watch;
  list_->find(chain.spheres(), pairs_, counts_);
  remember(chain);
  counts_stand_ = true;
  compared_ = list_->size();
  // The first use of a list brings it into the cache, and is no measure of the next ones.
  if (!fresh)
    policy_.used(watch.ms(), list_->skin(), static_cast<double>(compared_),
                 static_cast<double>(pairs_.size()));
}

/// Collisions of each sphere. Where there are many they are kept, for frames that change few.
void FrameSearch::count(std::uint32_t n, Collisions& result) {
  if (counts_stand_) return static_cast<void>(result.count.assign(counts_.begin(), counts_.end()));
  result.count.assign(n, 0);
  for (const Pair& p : pairs_) ++result.count[p.i], ++result.count[p.j];
  counts_stand_ = pairs_.size() > n / 4;
  if (counts_stand_) counts_.assign(result.count.begin(), result.count.end());
}

void FrameSearch::report(const Chain& chain, const Request& request, Collisions& result) {
  const std::uint32_t n = chain.size();
  if (request.want == Request::Want::any || request.queries.within(n) != SphereRange{0, n} ||
      pairs_.size() > request.pair_limit) {
    PairCollector collector(n, request, result);
    for (const Pair& p : pairs_) collector.lane(0).collide(p.i, p.j);
    return collector.finish();
  }
  count(n, result);
  result.found = !pairs_.empty();
  result.pair_count = pairs_.size();
  request.want == Request::Want::pairs ? result.pairs.assign(pairs_.begin(), pairs_.end())
                                       : result.pairs.clear();
}

void FrameSearch::find(const Chain& chain, const Request& request, Collisions& result, const FullSearch& here,
                       const FullSearch& search, double build_ms) {
  const Stopwatch watch;
  // Searched already: it is asked again about the same frame.
  if (answered_ && !behind_) return report(chain, request, result);
  behind_ = false;
  bool tree_stood = false;
  try {
    switch (way_) {
      case Way::full:
        search_all(chain, request, result, [&](const Chain& c, const Request& r, Collisions& found) {
          const Stopwatch searching;
          here(c, r, found);
          full_ms_ = build_ms + searching.ms();
        });
        policy_.searched(full_ms_);
        return;
      case Way::unmoved:
        break;
      case Way::parts:
      case Way::shifted:
        way_ == Way::parts ? row_.move(chain.spheres(), ranges_) : row_.shift(chain.spheres(), shift_);
        compared_ = row_.changed_runs();
        counts_stand_ &= way_ == Way::parts;
        tree_stood = row_.tree_stands();
        by_cells_ = row_.search(chain.view(), pairs_,
                                counts_stand_ ? std::span(counts_) : std::span<std::uint32_t>(), by_cells_);
        if (by_cells_)
          learn(cell_sphere_, watch.ms() / static_cast<double>(chain.size()));
        else if (compared_ > 0 && tree_stood)
          learn(run_, watch.ms() / static_cast<double>(compared_));
        break;
      case Way::kept_list:
        search_by_list(chain, search);
        break;
    }
  } catch (...) {
    forget();
    list_->drop();
    way_ = Way::full;
    throw;
  }
  report(chain, request, result);
  find_ms_ = watch.ms();
}

Plan FrameSearch::plan() const {
  if (!updated_) return {};
  const std::string saved = fmt::format("{:.3g} ms of a full search", policy_.full_ms());
  const auto left_out = [&](Omission omission, std::string reason, std::string removed) {
    return Decision{info_of(omission).step, true,     std::move(reason),
                    policy_.full_ms(),      find_ms_, std::move(removed)};
  };
  const std::size_t n = row_.spheres().size();
  switch (way_) {
    case Way::full:
      break;
    case Way::unmoved:
      return {left_out(Omission::unmoved, fmt::format("none of {} spheres differs", n), saved)};
    case Way::parts:
      return {left_out(Omission::still_parts, fmt::format("{} of {} spheres moved", moved_, n),
                       fmt::format("all but {} runs of {}", compared_, RunTree::run))};
    case Way::shifted:
      return {left_out(Omission::shifted, fmt::format("sphere i is what i {:+} was, of {}", shift_, n),
                       fmt::format("all but {} runs of {}", compared_, RunTree::run))};
    case Way::kept_list:
      return {left_out(Omission::far_pairs,
                       fmt::format("each of {} spheres is within a skin of {:.3g}", n, list_->skin()),
                       fmt::format("all but {} near pairs", compared_))};
  }
  return {{"search of the whole frame", false, "too little in common with the frame before", std::nullopt,
           full_ms_}};
}

}  // namespace catena

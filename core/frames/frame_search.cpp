#include "catena/core/frames/frame_search.h"

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/strategy/timings.h"

// A frame is searched in the way that was chosen for it.
namespace catena {
namespace {

constexpr std::uint64_t most_own_pairs = std::uint64_t{1} << 26;  // half a GiB

Request all_pairs() {
  Request everything;
  everything.pair_limit = most_own_pairs;
  return everything;
}

/// From the latest measurement; the first one replaces what was guessed.
void learn(FrameSearch::Learned& figure, double latest) {
  figure.ms = figure.measured ? 0.7 * figure.ms + 0.3 * latest : latest;
  figure.measured = true;
}

}  // namespace

/// The answer is that of this chain.
void FrameSearch::remember(const Chain& chain) {
  row_.hold(chain.spheres());
  topology_ = chain.view().topology;
  window_ = can_shift(chain) ? chain.exclusion().window : 0;
  answered_ = true;
}

/// True where `result` is the answer to the request; else it stands in answer_.
bool FrameSearch::search_all(const Chain& chain, const Request& request, Collisions& result,
                             const FullSearch& here) {
  const bool worth = frames_ && request.want != Request::Want::any &&
                     (always_ || (looks_.may_try() && knows_plain(request)));
  const bool all = request.want == Request::Want::pairs &&
                   request.queries.within(chain.size()) == SphereRange{0, chain.size()};
  if (!worth) return here(chain, request, result), true;
  if (all) {
    here(chain, request, result);
    if (&result != &answer_.room())
      answer_.copy(result);
    else
      answer_.found();
    return remember(chain), true;
  }
  try {
    here(chain, all_pairs(), answer_.room());
  } catch (const PairLimitExceeded&) {
    return here(chain, request, result), true;
  }
  answer_.found();
  return remember(chain), false;
}

void FrameSearch::search_by_list(const Chain& chain, const FullSearch& search) {
  const Stopwatch watch;
  const bool fresh = !list_->made();
  if (fresh) {
    list_->make(chain, static_cast<float>(skin_), static_cast<float>(inner_skin_), most_own_pairs,
                [&](const Chain& thick, const Request& request, Collisions& found) {
                  const Stopwatch searching;
                  search(thick, request, found);
                  policy_.searched_thicker(searching.ms());
                });
    by_list_ = false;
    made_ = true;
  }
  if (!list_->made()) {
    policy_.rebuilt(watch.ms(), move_, skin_, radius_);
    search(chain, all_pairs(), answer_.room());
    answer_.found();
    return remember(chain);
  }
  bool pruned = false;
  answer_.rewrite([&](std::vector<Pair>& pairs, std::vector<std::uint32_t>& counts, bool stand) {
    pruned = list_->find(chain.spheres(), pairs, counts, stand && by_list_);
  });
  by_list_ = true;
  remember(chain);
  compared_ = list_->open_size();
  if (fresh)
    policy_.rebuilt(watch.ms() + holds_ms_, move_, skin_, radius_);
  else if (pruned)
    policy_.pruned(watch.ms() + holds_ms_, static_cast<double>(list_->size()),
                   static_cast<double>(answer_.pairs().size()));
  else
    policy_.used(watch.ms() + holds_ms_);
}

/// Moves the row on to this frame, and the answer with it.
void FrameSearch::search_changes(const Chain& chain) {
  const Stopwatch watch;
  if (way_ == Way::shifted) {
    row_.shift(chain.spheres(), shift_);
    answer_.shift(chain.size(), shift_);
  } else {
    row_.move(chain.spheres(), ranges_);
  }
  compared_ = row_.changed_runs();
  const bool tree_stood = row_.tree_stands();
  row_.find_changed(answer_.pairs(), places_);
  by_cells_ = row_.search(chain.view(), fresh_, by_cells_);
  answer_.exchange(places_, fresh_);
  if (by_cells_)
    learn(cell_sphere_, watch.ms() / static_cast<double>(chain.size()));
  else if (compared_ > 0 && tree_stood)
    learn(run_, watch.ms() / static_cast<double>(compared_));
}

/// True where `result` is the answer to the request; else it stands in answer_.
bool FrameSearch::search(const Chain& chain, const Request& request, Collisions& result,
                         const FullSearch& here, const FullSearch& search, double build_ms) {
  // Searched already: it is asked again about the same frame.
  if (answered_ && !behind_) return false;
  behind_ = made_ = false;
  if (way_ != Way::kept_list && way_ != Way::unmoved) by_list_ = false;
  const Stopwatch watch;
  bool filled = false;
  try {
    switch (way_) {
      case Way::full:
        filled = search_all(chain, request, result, [&](const Chain& c, const Request& r, Collisions& found) {
          const Stopwatch searching;
          here(c, r, found);
          full_ms_ = build_ms + searching.ms();
        });
        policy_.searched(full_ms_);
        if (!answered_) learn_plain(request);
        heed_full_search();
        break;
      case Way::unmoved:
        break;
      case Way::parts:
      case Way::shifted:
        search_changes(chain);
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
  find_ms_ = watch.ms();
  settle(update_ms_ + (way_ == Way::full ? build_ms : 0) + find_ms_);
  return filled;
}

/// To find all pairs, and to keep them, takes more than what is asked for may: what that takes alone is worth
/// one frame of which the next one knows nothing.
bool FrameSearch::knows_plain(const Request& request) const {
  return policy_.cold() || !updated_ || (plain_ms_ > 0 && plain_want_ == request.want);
}
void FrameSearch::learn_plain(const Request& request) {
  const bool first = plain_ms_ == 0 || plain_want_ != request.want;
  plain_ms_ = first ? full_ms_ : std::min(full_ms_, 0.7 * plain_ms_ + 0.3 * full_ms_);
  plain_want_ = request.want;
}

/// What lists lost was lost beside a full search; where that takes much longer by now they are tried anew.
void FrameSearch::heed_full_search() {
  constexpr double much = 1.5;
  const double ms = policy_.full_ms();
  doubt_ = 0;
  if (policy_.cold()) return;
  if (beside_ms_ > 0 && ms > much * beside_ms_) lists_.begin(), beside_ms_ = ms;
  beside_ms_ = beside_ms_ > 0 ? std::min(beside_ms_, ms) : ms;
}

/// Books what the frame took beside a full search.
void FrameSearch::settle(double ms) {
  if (!updated_ || policy_.cold()) return;
  constexpr double most_of_a_look = 1, most_of_a_list = 8, most_of_the_first = 2;
  looks_.search(), lists_.search();
  constexpr double doubtful = 0.4;
  if (way_ != Way::full && !made_ && ms > doubtful * policy_.full_ms()) ++doubt_;
  if (way_ == Way::kept_list)
    lists_.used(ms, policy_.full_ms(), policy_.first_list() ? most_of_the_first : most_of_a_list);
  if (made_ || !answered_) return;
  const double without = way_ != Way::full ? policy_.full_ms()
                         : plain_ms_ > 0   ? std::min(plain_ms_, full_ms_)
                                           : full_ms_;
  looks_.used(ms, without, most_of_a_look);
}

void FrameSearch::find(const Chain& chain, const Request& request, Collisions& result, const FullSearch& here,
                       const FullSearch& other, double build_ms) {
  if (!search(chain, request, result, here, other, build_ms)) answer_.report(chain.size(), request, result);
}

const Collisions& FrameSearch::find_kept(const Chain& chain, const Request& request, const FullSearch& here,
                                         const FullSearch& other, double build_ms) {
  if (search(chain, request, answer_.room(), here, other, build_ms)) return answer_.room();
  return answer_.standing(chain.size(), request);
}

}  // namespace catena

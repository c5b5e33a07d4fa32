#include "catena/core/frames/frame_search.h"

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/strategy/timings.h"

// A frame is searched in the way that was chosen for it.
namespace catena {
namespace {

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

/// By a full search; `keep`: what all pairs are is worth knowing. True where `result` is the answer to the
/// request; else it stands in answer_.
bool FrameSearch::search_all(const Chain& chain, const Request& request, Collisions& result,
                             const FullSearch& full, double build_ms, bool keep) {
  forget();
  const auto search = [&](const Request& asked, Collisions& found) {
    const Stopwatch searching;
    full(chain, asked, found);
    full_ms_ = build_ms + searching.ms();
  };
  const bool whole = request.want != Request::Want::any &&
                     request.queries.within(chain.size()) == SphereRange{0, chain.size()};
  const bool as_asked = whole && request.want == Request::Want::pairs;
  if (keep && !as_asked) try {
      search({.pair_limit = most_pairs_}, answer_.room());
      answer_.found();
      return remember(chain), false;
    } catch (const PairLimitExceeded&) {
      in_vain_ = true;
      answer_.room() = {};
    }
  search(request, result);
  if (whole) crowded_ = result.pair_count > most_pairs_;
  if (!keep || !as_asked || result.pair_count > FrameAnswer::most_pairs) return true;
  if (&result != &answer_.room())
    answer_.copy(result);
  else
    answer_.found();
  return remember(chain), true;
}

/// True where `result` is the answer to the request; else it stands in answer_.
bool FrameSearch::search_by_list(const Chain& chain, const Request& request, Collisions& result,
                                 const FullSearch& search) {
  const Stopwatch watch;
  const bool fresh = !list_->made();
  if (fresh) {
    list_->make(chain, static_cast<float>(skin_), static_cast<float>(inner_skin_), most_pairs_,
                [&](const Chain& thick, const Request& all_pairs, Collisions& found) {
                  const Stopwatch searching;
                  search(thick, all_pairs, found);
                  policy_.searched_thicker(searching.ms());
                });
    made_ = true;
  }
  if (!list_->made()) {
    policy_.rebuilt(watch.ms(), move_, skin_, radius_);
    way_ = Way::full, why_ = Why::no_list;
    return search_all(chain, request, result, search, 0, request.want != Request::Want::any);
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
  return false;
}

/// Moves the row on to this frame, and the answer with it; where too many pairs come, as of what moves onto
/// one point, all is searched as it was asked. True where `result` is the answer then.
bool FrameSearch::search_changes(const Chain& chain, const Request& request, Collisions& result,
                                 const FullSearch& search) {
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
  const std::uint64_t asked = request.want == Request::Want::pairs ? request.pair_limit : 0,
                      most = std::min(std::max(most_pairs_, asked), FrameAnswer::most_pairs),
                      stay = answer_.pairs().size() - places_.size(),
                      many = 4 * (chain.size() + answer_.pairs().size()),  // no small change any more
      room = std::min(many, most - std::min(most, stay));
  by_cells_ = row_.search(chain.view(), fresh_, by_cells_, room);
  if (fresh_.size() > room) {
    fresh_ = {};
    in_vain_ = true;
    way_ = Way::full, why_ = Why::crowded;
    return search_all(chain, request, result, search, 0, false);
  }
  answer_.exchange(places_, fresh_);
  if (by_cells_)
    learn(cell_sphere_, watch.ms() / static_cast<double>(chain.size()));
  else if (compared_ > 0 && tree_stood)
    learn(run_, watch.ms() / static_cast<double>(compared_));
  return false;
}

/// True where `result` is the answer to the request; else it stands in answer_.
bool FrameSearch::search(const Chain& chain, const Request& request, Collisions& result,
                         const FullSearch& here, const FullSearch& search, double build_ms) {
  // Searched already: it is asked again about the same frame.
  if (answered_ && !behind_) return false;
  behind_ = made_ = in_vain_ = false;
  if (way_ != Way::kept_list && way_ != Way::unmoved) by_list_ = false;
  const Stopwatch watch;
  const double built_ms = way_ == Way::full ? build_ms : 0;
  bool filled = false;
  try {
    switch (way_) {
      case Way::full:
        filled = search_all(chain, request, result, here, build_ms, worth_keeping(request));
        break;
      case Way::unmoved:
        break;
      case Way::parts:
      case Way::shifted:
        filled = search_changes(chain, request, result, search);
        break;
      case Way::kept_list:
        filled = search_by_list(chain, request, result, search);
        break;
    }
  } catch (...) {
    forget();
    list_->drop();
    way_ = Way::full;
    throw;
  }
  if (way_ == Way::full) {
    policy_.searched(full_ms_);
    if (!answered_) learn_plain(request);
    heed_full_search();
  }
  find_ms_ = watch.ms();
  settle(update_ms_ + built_ms + find_ms_);
  return filled;
}

/// All pairs, whatever is asked for, so that the next frame may be searched by them.
bool FrameSearch::worth_keeping(const Request& request) const {
  if (!frames_ || request.want == Request::Want::any) return false;
  return always_ || (!crowded_ && looks_.may_try() && knows_plain(request));
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
  if (way_ == Way::kept_list || made_)
    lists_.used(ms, policy_.full_ms(), policy_.first_list() ? most_of_the_first : most_of_a_list);
  if (made_ || !(answered_ || in_vain_)) return;
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

#include "catena/core/plan/planned_search.h"

#include <fmt/format.h>

#include <limits>
#include <new>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

/// A search whose omissions are switched off finds more than was asked for.
void drop_unasked(Request::Want want, Collisions& result) {
  if (want != Request::Want::pairs) result.pairs.clear();
  if (want == Request::Want::any) result.count.clear(), result.pair_count = 0;
}

}  // namespace

void PlannedSearch::begin(const Chain& chain, const Request& request, bool frame) {
  spheres_.reset();
  built_ = false;
  request_ = request;
  const ChainView view = chain.view();
  topology_ = view.topology;
  if (!frame) stands_ = nullptr;
  if (plan_holds(view, frame)) return;
  try {
    plan_.emplace(chain.size(), request_, Machine::here(), omissions_, view, history_);
    const Rivals::Contender planned{plan_->variant(), plan_->threads()};
    const bool others = plan_->on_device() || chain.size() != rivals_.spheres();
    others ? rivals_.begin(planned, chain.size()) : rivals_.go_on(planned);
  } catch (...) {
    plan_.reset();  // nobody has its place
    throw;
  }
}

/// Of which kind a chain is, is looked at again for some frames only.
bool PlannedSearch::plan_holds(const ChainView& chain, bool frame) {
  constexpr unsigned frames_of_a_look = 16;
  if (frame && ++since_look_ < frames_of_a_look && plan_)
    return plan_->holds_for_frame(chain.size, request_, history_);
  since_look_ = 0;
  return plan_ && plan_->holds_for(chain.size, request_, chain, history_);
}

void PlannedSearch::build(const Chain& chain, const Request& request) {
  with_room([&] {
    built_ = told_ = false;
    if (searcher_ == nullptr || turn_ != rivals_.turn()) {
      searcher_ = nullptr;  // where there is no memory for the next one
      turn_ = rivals_.turn(), searcher_is_ = rivals_.next();
      searcher_ = &held(searcher_is_);
      planned_ = searcher_is_ == rivals_.planned();
    }
    const bool moved = std::exchange(stands_, nullptr) == searcher_;
    searcher_->prepare(request);
    moved&& omissions_.may(Omission::sort) ? searcher_->update(chain) : searcher_->build(chain);
    built_ = true;
    stands_ = searcher_;
    if (const auto gone = rivals_.take_lost())  // it will not be asked for long, and has memory
      std::erase_if(held_, [&](const Held& h) { return h.who == *gone && h.variant.get() != searcher_; });
  });
}

void PlannedSearch::find(const Chain& chain, const Request& request, Collisions& result) {
  Request wider = request;
  wider.want = plan_->searched_for(request.want);
  // A limit is for who asks for pairs.
  if (wider.want != request.want) wider.pair_limit = std::numeric_limits<std::uint64_t>::max();
  with_room([&] {
    if (!built_) build(chain);
    searcher_->find(chain, wider, result);
  });
  if (wider.want != Request::Want::any && wider.queries == SphereRange{}) learn(chain, wider.want);
  drop_unasked(request.want, result);
}

/// From what a whole search of this chain took.
void PlannedSearch::learn(const Chain& chain, Request::Want want) {
  const Timings took = searcher_->timings();
  const double ms = took.build_ms + took.find_ms;
  if (planned_) plan_->tell(ms, history_);
  // A frame that is kept is searched for more than others.
  const bool comparable = turn_ == rivals_.turn() && want == plan_->want();
  if (std::exchange(told_, true) || alone_ || !comparable) return;
  rivals_.took(ms);
  try {
    if (rivals_.expected()) rivals_.join(plan_->rivals(chain.view().extent), plan_->worth_trying_ms());
  } catch (const std::bad_alloc&) {  // the answer is right, and there
  }
}

void PlannedSearch::find_other(const Chain& chain, const Request& request, Collisions& result) {
  const bool same_spheres = chain.size() == spheres_ && topology_ != 0 && chain.view().topology == topology_;
  const auto forget_build = [&] {
    built_ = false;
    if (!same_spheres) stands_ = nullptr;
  };
  forget_build();
  try {
    with_room([&] {
      if (!built_) build(chain, request);
      searcher_->find(chain, request, result);
    });
  } catch (...) {
    forget_build();  // or the next find would be answered of this chain
    throw;
  }
  forget_build();
}

/// Where a device has no room for what is planned, again by what the plan has for that; where a rival has
/// none, without it.
template <class Work>
void PlannedSearch::with_room(const Work& work) {
  for (;;) try {
      return work();
    } catch (const CapacityError& none) {
      if (!gives_way(none.what())) throw;
    } catch (const std::bad_alloc& none) {
      if (!rival_gives_way()) throw;
    }
}

bool PlannedSearch::gives_way(const std::string& why) {
  if (rival_gives_way()) return true;
  const Rivals::Contender gone = searcher_is_;
  if (!plan_->give_way(why)) return false;
  rivals_.begin({plan_->variant(), plan_->threads()}, spheres_.value_or(0));
  return forget(gone), true;
}

bool PlannedSearch::rival_gives_way() {
  if (plan_->on_device() || searcher_is_ == rivals_.planned()) return false;
  rivals_.without(searcher_is_);
  return forget(searcher_is_), true;
}

/// Its memory is needed.
void PlannedSearch::forget(const Rivals::Contender& who) {
  built_ = false;
  stands_ = searcher_ = nullptr;
  std::erase_if(held_, [&](const Held& h) { return h.who == who; });
}

/// With its memory, where it searched before.
Variant& PlannedSearch::held(const Rivals::Contender& who) {
  for (const Held& h : held_)
    if (h.who == who) return *h.variant;
  held_.push_back({who, StrategyRegistry::instance().make_held(plan_->named(who))});
  return *held_.back().variant;
}

Plan PlannedSearch::steps() const {
  Plan steps = plan_->steps();
  if (!rivals_.replaced()) return steps;
  const Rivals::Contender& leader = rivals_.leader();
  steps.front().estimate_ms.reset();  // of the planned one
  steps.front().reason += fmt::format("; {} in its place, which {}", plan_->named(leader), rivals_.told_ms());
  for (Decision& step : steps)
    if (step.step == info_of(Omission::threads).step && leader.threads == 1 && !step.left_out)
      step.left_out = true, step.reason += "; one in their place";
  return steps;
}

}  // namespace catena

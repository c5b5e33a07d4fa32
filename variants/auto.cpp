#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/frames/frame_search.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/part_look.h"
#include "catena/core/plan/rivals.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/evidence_nodes.h"
#include "catena/core/strategy/keeps_answer.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// auto: what a plan chooses for the chain, and leaves out for the request; of a frame it searches what the
/// last one does not tell.
template <class Arithmetic>
class Auto final : public Variant, public KeepsAnswer, public EvidenceNodes {
 public:
  explicit Auto(const Parameters& parameters)
      : omissions_(Omissions::without(parameters.choices("keep", omission_names()))),
        always_(parameters.choice("frames", {"measured", "always"}) == "always"),
        alone_(always_ || parameters.choice("rivals", {"measured", "none"}) == "none"),
        frames_(omissions_, always_) {}

  void prepare(const Request& request) override { prepared_ = request; }

  void build(const Chain& chain) override {
    contact_.reset();
    request_ = prepared_;
    frames_.begin(request_.frames_follow);
    begin(chain, nullptr);
  }

  void update(const Chain& chain, const Moved& moved) override {
    if (spheres_ != chain.size()) return build(chain);
    request_ = prepared_;
    begin(chain, &moved);
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (built_ && spheres_ == chain.size() && !(frames_count() && frames_.expected())) {
      // A chain alone: nothing is done besides, and the searcher's own times are the times.
      search_here(chain, request, result);
      const Timings own = searcher_->timings();
      timings_ = plan_->on_device() ? own : Timings{build_timings_.build_ms, own.find_ms};
      return;
    }
    timed(chain, [&](const FullSearch& here, const FullSearch& other, double build_ms) {
      if (answered_by_contact(request))
        report_contact(chain, request, result);
      else if (frames_count())
        frames_.find(chain, request, result, here, other, build_ms);
      else
        search_here(chain, request, result);
    });
  }

  const Collisions& find_kept(const Chain& chain, const Request& request) override {
    const Collisions* answer = nullptr;
    if (!answered_by_contact(request) && frames_count() && request.queries == SphereRange{})
      timed(chain, [&](const FullSearch& here, const FullSearch& other, double build_ms) {
        answer = &frames_.find_kept(chain, request, here, other, build_ms);
      });
    else
      find(chain, request, own_), answer = &own_;
    return *answer;
  }

  /// That of what it chose for the last build; before the first, of what it would choose on a host. None
  /// where nothing was built: an earlier frame, or a look, answers.
  Accounting evidence() const override {
    if (!spheres_) return Accounting::each_pair;
    return built_ ? searcher_->evidence() : Accounting::none;
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    if (!built_) throw std::logic_error("find_with_evidence: nothing was built");
    searcher_->find_with_evidence(chain, request, result, sink);
  }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (built_) visit_evidence_nodes(*searcher_, chain, visitor);
  }

  Timings timings() const override { return timings_; }

  std::string answered_by() const override {
    if (!plan_) return {};
    if (contact_) return "a look at likely places";
    return frames_count() && frames_.way() != FrameSearch::Way::full ? "the frame before"
           : searcher_ != nullptr                                    ? plan_->named(searcher_is_)
                                                                     : plan_->variant_with_threads();
  }

  Plan plan() const override {
    if (!plan_) return {};
    Plan steps = plan_->steps();
    if (rivals_.replaced()) tell_of_rivals(steps);
    if (!built_)
      for (Decision& step : steps)
        if (step.step == info_of(Omission::hierarchy).step)
          step.left_out = true, step.reason += "; nothing was built";
    steps.front().actual_ms = timings_.build_ms + timings_.find_ms + timings_.transfer_ms;
    if (contact_)
      steps.back().removed =
          fmt::format("build and search: spheres {} and {} collide", contact_->i, contact_->j);
    if (frames_count())
      for (Decision& decision : frames_.plan()) steps.push_back(std::move(decision));
    if (built_)
      for (Decision& decision : searcher_->plan()) steps.push_back(std::move(decision));
    return steps;
  }

 private:
  /// `moved`: since the last one, of which this is the next frame; null where it is none.
  void begin(const Chain& chain, const Moved* moved) {
    const bool updates = moved != nullptr;
    spheres_.reset();
    built_ = false;
    topology_ = chain.view().topology;
    if (!updates) stands_ = nullptr;
    const Extent extent = chain.view().extent;
    if (!plan_holds(chain, updates)) try {
        plan_.emplace(chain.size(), request_, Machine::here(), omissions_, extent, chain.spheres(), history_);
        const Rivals::Contender planned{plan_->variant(), plan_->threads()};
        const bool others = plan_->on_device() || chain.size() != rivals_.spheres();
        others ? rivals_.begin(planned, chain.size()) : rivals_.go_on(planned);
      } catch (...) {
        plan_.reset();  // nobody has its place
        throw;
      }
    if (!plan_->look_first()) contact_.reset();  // of a frame of which something else was asked
    if (!updates && !plan_->look_first() && !request_.frames_follow && !always_) {
      // A chain alone: choosing took less than it takes to look at the clock.
      build_searcher(chain);
      spheres_ = chain.size();
      timings_ = build_timings_ = searcher_->timings();
      building_ms_ = build_timings_.build_ms + build_timings_.transfer_ms;
      return;
    }
    const Stopwatch watch;
    if (plan_->look_first()) {
      if (contact_) contact_ = CoarseLook::look_near(chain.view(), request_.queries, *contact_);
      if (!contact_) contact_ = look_.look(chain.view(), request_.queries);
      if (!contact_) contact_ = part_look_.look(chain.view(), request_.queries);
    }
    // It heeds also frames that it has no part in: what moved is told of the last one, whatever was asked of
    // it.
    if (updates) frames_count() ? void(frames_.update(chain, *moved)) : frames_.passed();
    const double looked_ms = watch.ms();
    if (!contact_ && frames_.way() == FrameSearch::Way::full) build_searcher(chain);
    spheres_ = chain.size();
    building_ms_ = watch.ms() - looked_ms;
    build_timings_ = built_ && plan_->on_device() ? searcher_->timings() : Timings{watch.ms()};
    timings_ = build_timings_;
  }

  /// What a frame before tells is of use: all is searched, and for more than yes or no.
  bool frames_count() const {
    return plan_ && plan_->want() != Request::Want::any && request_.queries == SphereRange{} &&
           (always_ || !plan_->all_pairs());
  }

  /// A find, which `search` does: it is given how this chain and how any other is searched, and what building
  /// this one took.
  template <class Search>
  void timed(const Chain& chain, const Search& search) {
    if (spheres_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    timings_ = build_timings_;
    search([this](const Chain& c, const Request& r, Collisions& found) { search_here(c, r, found); },
           [this](const Chain& c, const Request& r, Collisions& found) { search_other(c, r, found); },
           building_ms_);
    if (built_ && plan_->on_device())
      timings_ = searcher_->timings();
    else
      timings_.find_ms = watch.ms();
  }

  bool answered_by_contact(const Request& request) const {
    return contact_ && request.want == Request::Want::any && request.queries == request_.queries;
  }
  void report_contact(const Chain& chain, const Request& request, Collisions& result) const {
    PairCollector collector(chain.size(), request, result);
    collector.lane(0).pair(contact_->i, contact_->j);
    collector.finish();
  }

  void tell_of_rivals(Plan& steps) const {
    const Rivals::Contender& leader = rivals_.leader();
    steps.front().estimate_ms.reset();  // of the planned one
    steps.front().reason += fmt::format("; {} in its place, which took {:.3g} ms where {:.3g} were taken",
                                        plan_->named(leader), rivals_.leader_ms(), rivals_.other_ms());
    for (Decision& step : steps)
      if (step.step == info_of(Omission::threads).step && leader.threads == 1 && !step.left_out)
        step.left_out = true, step.reason += "; one in their place";
  }
  /// Of which kind a chain is, is looked at again for some frames only.
  bool plan_holds(const Chain& chain, bool updates) {
    constexpr unsigned frames_of_a_look = 16;
    if (updates && ++since_look_ < frames_of_a_look && plan_)
      return plan_->holds_for_frame(chain.size(), request_, history_);
    since_look_ = 0;
    return plan_ && plan_->holds_for(chain.size(), request_, chain.view().extent, chain.spheres(), history_);
  }
  void build_searcher(const Chain& chain) { build_searcher(chain, request_); }
  void build_searcher(const Chain& chain, const Request& request) {
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

  void search_here(const Chain& chain, const Request& request, Collisions& result) {
    Request wider = request;
    wider.want = plan_->searched_for(request.want);
    // A limit is for who asks for pairs.
    if (wider.want != request.want) wider.pair_limit = std::numeric_limits<std::uint64_t>::max();
    with_room([&] {
      if (!built_) build_searcher(chain);
      searcher_->find(chain, wider, result);
    });
    if (wider.want != Request::Want::any && wider.queries == SphereRange{})
      learn(searcher_->timings(), wider.want, chain.view().extent);
    drop_unasked(request.want, result);
  }
  /// From what a whole search took.
  void learn(const Timings& took, Request::Want want, const Extent& extent) {
    const double ms = took.build_ms + took.find_ms;
    if (planned_) plan_->tell(ms, history_);
    // A frame that is kept is searched for more than others.
    const bool comparable = turn_ == rivals_.turn() && want == plan_->want();
    if (std::exchange(told_, true) || alone_ || !comparable) return;
    rivals_.took(ms);
    if (rivals_.expected()) rivals_.join(plan_->rivals(extent), plan_->worth_trying_ms());
  }
  /// Of another chain; that of the last build is none any more. It may be of the same spheres, only thicker.
  void search_other(const Chain& chain, const Request& request, Collisions& result) {
    const bool same_spheres =
        chain.size() == spheres_ && topology_ != 0 && chain.view().topology == topology_;
    const auto forget_build = [&] {
      built_ = false;
      if (!same_spheres) stands_ = nullptr;
    };
    forget_build();
    try {
      with_room([&] {
        if (!built_) build_searcher(chain, request);
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
  void with_room(const Work& work) {
    for (;;) try {
        return work();
      } catch (const CapacityError& none) {
        if (!gives_way(none.what())) throw;
      } catch (const std::bad_alloc& none) {
        if (!rival_gives_way()) throw;
      }
  }
  bool gives_way(const std::string& why) {
    if (rival_gives_way()) return true;
    const Rivals::Contender gone = searcher_is_;
    if (!plan_->give_way(why)) return false;
    rivals_.begin({plan_->variant(), plan_->threads()}, spheres_.value_or(0));
    return forget(gone), true;
  }
  bool rival_gives_way() {
    if (plan_->on_device() || searcher_is_ == rivals_.planned()) return false;
    rivals_.without(searcher_is_);
    return forget(searcher_is_), true;
  }
  /// Its memory is needed.
  void forget(const Rivals::Contender& who) {
    built_ = false;
    stands_ = searcher_ = nullptr;
    std::erase_if(held_, [&](const Held& h) { return h.who == who; });
  }

  /// With its memory, where it searched before.
  Variant& held(const Rivals::Contender& who) {
    for (const Held& h : held_)
      if (h.who == who) return *h.variant;
    held_.push_back({who, StrategyRegistry::instance().make(plan_->named(who))});
    return *held_.back().variant;
  }

  /// A search whose omissions are switched off finds more than was asked for.
  static void drop_unasked(Request::Want want, Collisions& result) {
    if (want != Request::Want::pairs) result.pairs.clear();
    if (want == Request::Want::any) result.count.clear(), result.pair_count = 0;
  }

  const Omissions omissions_;
  const bool always_, alone_;
  Request prepared_, request_;  ///< for the next build, and of the last one
  std::optional<SearchPlan> plan_;
  unsigned since_look_ = 0;  ///< frames since it was looked of which kind the chain is
  SearchHistory history_;
  CoarseLook look_;
  PartLook part_look_;
  std::optional<Pair> contact_;  ///< of the last frame, found by a look
  FrameSearch frames_;
  struct Held {
    Rivals::Contender who;
    std::unique_ptr<Variant> variant;
  };
  std::vector<Held> held_;
  Rivals rivals_;
  Rivals::Contender searcher_is_;         ///< of the last build
  std::uint64_t turn_ = 0;                ///< of rivals_, then
  bool planned_ = true;                   ///< it is the planned one
  bool told_ = false;                     ///< what that took
  Variant* searcher_ = nullptr;           ///< of held_
  std::uint64_t topology_ = 0;            ///< of the last build or update; see ChainView
  const Variant* stands_ = nullptr;  ///< that whose last build was of an earlier frame of the same spheres
  bool built_ = false;                    ///< the searcher, on the chain of the last build or update
  std::optional<std::uint32_t> spheres_;  ///< of the last build or update
  Timings timings_, build_timings_;
  double building_ms_ = 0;  ///< of the searcher alone, by the last build or update
  Collisions own_;          ///< of a find_kept that no frame before helps
};

const RegisterVariant<Auto, Robust> registered{
    {.name = "auto",
     .summary = "what a plan chooses for the chain, and leaves out for the request",
     .parameters = {{"keep", "none", "omissions that are switched off, joined by '+'"},
                    {"frames", "measured", "what frames have in common is used where it pays, or always"},
                    {"rivals", "measured",
                     "of many searches a few are done by others than what was planned, in whose place the "
                     "quickest goes on, or none"}}}};

}  // namespace
}  // namespace catena

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/frames/frame_search.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/part_look.h"
#include "catena/core/plan/planned_search.h"
#include "catena/core/plan/run_account.h"
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
      : omissions_(parameters.given("keep") ? Omissions::without(parameters.choices("keep", omission_names()))
                                            : Omissions()),
        always_(parameters.choice("frames", {"measured", "always"}) == "always"),
        times_planning_(parameters.choice("planning", {"untimed", "timed"}) == "timed"),
        whole_(omissions_, always_ || parameters.choice("rivals", {"measured", "none"}) == "none") {}

  void prepare(const Request& request) override { prepared_ = request; }

  void build(const Chain& chain) override {
    contact_.reset();
    request_ = prepared_;
    begin(chain, nullptr);
  }

  void update(const Chain& chain, const Moved& moved) override {
    if (whole_.spheres() != chain.size()) return build(chain);
    request_ = prepared_;
    begin(chain, &moved);
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (whole_.built() && whole_.spheres() == chain.size() &&
        !(frames_ && frames_count() && frames_->expected())) {
      // A chain alone: nothing is done besides, and the searcher's own times are the times.
      whole_.find(chain, request, result);
      const Timings own = whole_.searcher().timings();
      timings_ = whole_.plan()->on_device() ? own : Timings{build_timings_.build_ms, own.find_ms};
      pairs_ = result.pair_count;
      return;
    }
    timed(chain, [&](const FullSearch& here, const FullSearch& other, double build_ms) {
      if (answered_by_contact(request))
        report_contact(chain, request, result);
      else if (frames_count())
        frames().find(chain, request, result, here, other, build_ms);
      else
        whole_.find(chain, request, result);
    });
    pairs_ = result.pair_count;
  }

  const Collisions& find_kept(const Chain& chain, const Request& request) override {
    const Collisions* answer = nullptr;
    if (!answered_by_contact(request) && frames_count() && request.queries == SphereRange{})
      timed(chain, [&](const FullSearch& here, const FullSearch& other, double build_ms) {
        answer = &frames().find_kept(chain, request, here, other, build_ms);
        pairs_ = answer->pair_count;
      });
    else
      find(chain, request, own_), answer = &own_;
    return *answer;
  }

  /// That of what it chose for the last build; before the first, of what it would choose on a host. None
  /// where nothing was built: an earlier frame, or a look, answers.
  Accounting evidence() const override {
    if (!whole_.spheres()) return Accounting::each_pair;
    return whole_.built() ? whole_.searcher().evidence() : Accounting::none;
  }
  void find_with_evidence(const Chain& chain, const Request& request, Collisions& result,
                          EvidenceSink& sink) override {
    if (!whole_.built()) throw std::logic_error("find_with_evidence: nothing was built");
    whole_.searcher().find_with_evidence(chain, request, result, sink);
  }
  void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const override {
    if (whole_.built()) visit_evidence_nodes(whole_.searcher(), chain, visitor);
  }

  Timings timings() const override { return timings_; }

  std::string answered_by() const override {
    if (whole_.plan() == nullptr) return {};
    if (contact_) return "a look at likely places";
    return frames_count() && way() != FrameSearch::Way::full ? "the frame before" : whole_.answered_by();
  }

  Plan plan() const override {
    if (whole_.plan() == nullptr) return {};
    Plan steps = whole_.steps();
    if (!whole_.built())
      for (Decision& step : steps)
        if (step.step == info_of(Omission::hierarchy).step)
          step.left_out = true, step.reason += "; nothing was built";
    if (contact_)
      steps.back().removed =
          fmt::format("build and search: spheres {} and {} collide", contact_->i, contact_->j);
    tell_run(account(), steps);
    if (frames_ && frames_count())
      for (Decision& decision : frames_->plan()) steps.push_back(std::move(decision));
    if (whole_.built())
      for (Decision& decision : whole_.searcher().plan()) steps.push_back(std::move(decision));
    return steps;
  }

 private:
  /// `moved`: since the last one, of which this is the next frame; null where it is none.
  void begin(const Chain& chain, const Moved* moved) {
    const bool updates = moved != nullptr;
    look_ms_.reset();
    plan_search(chain, updates);
    if (!updates && (frames_ || request_.frames_follow || always_)) frames().begin(request_.frames_follow);
    const bool look_first = whole_.plan()->look_first();
    if (!look_first) contact_.reset();  // of a frame of which something else was asked
    if (!updates && !look_first && !request_.frames_follow && !always_) {
      // A chain alone: choosing took less than it takes to look at the clock.
      whole_.build(chain);
      whole_.begun(chain);
      timings_ = build_timings_ = whole_.searcher().timings();
      building_ms_ = build_timings_.build_ms + build_timings_.transfer_ms;
      return;
    }
    const Stopwatch watch;
    if (look_first) look(chain), look_ms_ = watch.ms();
    // It heeds also frames that it has no part in: what moved is told of the last one, whatever was asked of
    // it.
    if (updates && frames_count())
      frames().update(chain, *moved);
    else if (updates && frames_)
      frames_->passed();
    const double looked_ms = watch.ms();
    if (!contact_ && way() == FrameSearch::Way::full) whole_.build(chain);
    whole_.begun(chain);
    building_ms_ = watch.ms() - looked_ms;
    build_timings_ =
        whole_.built() && whole_.plan()->on_device() ? whole_.searcher().timings() : Timings{watch.ms()};
    timings_ = build_timings_;
  }

  void plan_search(const Chain& chain, bool updates) {
    if (!times_planning_) return whole_.begin(chain, request_, updates);
    const Stopwatch watch;
    whole_.begin(chain, request_, updates);
    planning_ms_ = watch.ms();
    planning_again_ms_.reset();
    if (updates) return;
    const Stopwatch again;
    const SearchPlan same(chain.size(), request_, Machine::here(), omissions_, chain.view());
    planning_again_ms_ = again.ms();
  }

  RunAccount account() const {
    RunAccount run{
        whole_.spheres().value_or(0), timings_, planning_ms_, planning_again_ms_, look_ms_, {}, {}};
    if (request_.want == Request::Want::counts) run.unlisted = pairs_;
    if (whole_.built())
      run.searcher = {whole_.answered_by(), whole_.plan()->all_pairs(), whole_.searcher().timings(),
                      whole_.searcher().work()};
    return run;
  }

  /// For a pair where one is likeliest, before anything is built: first where the last frame had one.
  void look(const Chain& chain) {
    if (!looks_) looks_ = std::make_unique<Looks>();
    if (contact_) contact_ = CoarseLook::look_near(chain.view(), request_.queries, *contact_);
    if (!contact_) contact_ = looks_->coarse.look(chain.view(), request_.queries);
    if (!contact_) contact_ = looks_->part.look(chain.view(), request_.queries);
  }

  /// What a frame before tells is of use: all is searched, and for more than yes or no.
  bool frames_count() const {
    const SearchPlan* const plan = whole_.plan();
    return plan != nullptr && plan->want() != Request::Want::any && request_.queries == SphereRange{} &&
           (always_ || !plan->all_pairs());
  }
  FrameSearch& frames() {
    if (!frames_) frames_ = std::make_unique<FrameSearch>(omissions_, always_);
    return *frames_;
  }
  FrameSearch::Way way() const { return frames_ ? frames_->way() : FrameSearch::Way::full; }

  /// A find, which `search` does: it is given how this chain and how any other is searched, and what building
  /// this one took.
  template <class Search>
  void timed(const Chain& chain, const Search& search) {
    if (whole_.spheres() != chain.size()) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    timings_ = build_timings_;
    search([this](const Chain& c, const Request& r, Collisions& found) { whole_.find(c, r, found); },
           [this](const Chain& c, const Request& r, Collisions& found) { whole_.find_other(c, r, found); },
           building_ms_);
    if (whole_.built() && whole_.plan()->on_device())
      timings_ = whole_.searcher().timings();
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

  const Omissions omissions_;
  const bool always_, times_planning_;
  Request prepared_, request_;  ///< for the next build, and of the last one
  PlannedSearch whole_;
  std::optional<Pair> contact_;  ///< of the last frame, found by a look
  // Made when they are needed: that takes as long as a search of a few spheres.
  struct Looks {
    CoarseLook coarse;
    PartLook part;
  };
  std::unique_ptr<Looks> looks_;
  std::unique_ptr<FrameSearch> frames_;
  Timings timings_, build_timings_;
  double building_ms_ = 0;  ///< of the searcher alone, by the last build or update
  std::optional<double> planning_ms_, planning_again_ms_, look_ms_;
  std::uint64_t pairs_ = 0;  ///< of the last find
  Collisions own_;           ///< of a find_kept that no frame before helps
};

const RegisterVariant<Auto, Robust> registered{
    {.name = "auto",
     .summary = "what a plan chooses for the chain, and leaves out for the request",
     .parameters = {
         {"keep", "none", "omissions that are switched off, joined by '+'"},
         {"frames", "measured", "what frames have in common is used where it pays, or always"},
         {"rivals", "measured",
          "of many searches a few are done by others than what was planned, in whose place the "
          "quickest goes on, or none"},
         {"planning", "untimed",
          "whether its plan tells how long choosing took, for which the clock is looked at (timed)"}}}};

}  // namespace
}  // namespace catena

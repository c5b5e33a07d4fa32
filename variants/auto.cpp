#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// auto: what a plan chooses for the chain, and leaves out for the request.
template <class Arithmetic>
class Auto final : public Variant {
 public:
  explicit Auto(const Parameters& parameters)
      : omissions_(Omissions::without(parameters.choices("keep", omission_names()))) {}

  void prepare(const Request& request) override { request_ = request; }

  void build(const Chain& chain) override {
    const Stopwatch watch;
    spheres_.reset();
    contact_.reset();
    plan_.emplace(chain.size(), request_, Machine::here(), omissions_);
    if (plan_->look_first()) contact_ = look_.look(chain.view(), request_.queries);
    searcher_ = nullptr;
    if (!contact_) build_searcher(chain);
    spheres_ = chain.size();
    timings_ = searcher_ != nullptr && plan_->on_device() ? searcher_->timings() : Timings{watch.ms()};
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (spheres_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    if (contact_ && request.want == Request::Want::any && request.queries == request_.queries) {
      PairCollector collector(chain.size(), request, result);
      collector.lane(0).pair(contact_->i, contact_->j);
      collector.finish();
      timings_.find_ms = watch.ms();
      return;
    }
    if (searcher_ == nullptr) build_searcher(chain);  // more is asked than was prepared for
    Request wider = request;
    wider.want = std::max(request.want, plan_->want());
    searcher_->find(chain, wider, result);
    drop_unasked(request.want, result);
    timings_.find_ms = watch.ms();
    if (plan_->on_device()) timings_ = searcher_->timings();
  }

  Timings timings() const override { return timings_; }

  std::string answered_by() const override {
    if (!plan_) return {};
    return searcher_ != nullptr ? plan_->variant() : "a look at likely places";
  }

  Plan plan() const override {
    if (!plan_) return {};
    Plan steps = plan_->steps();
    steps.front().actual_ms = timings_.build_ms + timings_.find_ms + timings_.transfer_ms;
    if (contact_)
      steps.back().removed = "build and search: spheres " + std::to_string(contact_->i) + " and " +
                             std::to_string(contact_->j) + " collide";
    if (searcher_ != nullptr)
      for (Decision& decision : searcher_->plan()) steps.push_back(std::move(decision));
    return steps;
  }

 private:
  void build_searcher(const Chain& chain) {
    searcher_ = &held(plan_->variant());
    searcher_->prepare(request_);
    searcher_->build(chain);
  }

  /// Variants that were chosen before, with their memory.
  Variant& held(const std::string& name) {
    for (const auto& [known, variant] : held_)
      if (known == name) return *variant;
    held_.emplace_back(name, StrategyRegistry::instance().make(name));
    return *held_.back().second;
  }

  /// A search whose omissions are switched off finds more than was asked for.
  static void drop_unasked(Request::Want want, Collisions& result) {
    if (want != Request::Want::pairs) result.pairs.clear();
    if (want == Request::Want::any) result.count.clear(), result.pair_count = 0;
  }

  const Omissions omissions_;
  Request request_;
  std::optional<SearchPlan> plan_;
  CoarseLook look_;
  std::optional<Pair> contact_;  ///< found by the look: nothing was built
  std::vector<std::pair<std::string, std::unique_ptr<Variant>>> held_;
  Variant* searcher_ = nullptr;            ///< of held_, built on the chain; null: nothing was built
  std::optional<std::uint32_t> spheres_;  ///< of the last build
  Timings timings_;
};

const RegisterVariant<Auto, Robust> registered{
    {.name = "auto",
     .summary = "what a plan chooses for the chain, and leaves out for the request",
     .parameters = {{"keep", "none", "omissions that are switched off, joined by '+'"}}}};

}  // namespace
}  // namespace catena

#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/plan/rivals.h"
#include "catena/core/plan/search_history.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// Searches chains, one after another, whole: by what a plan chooses for each, or by a rival that was found
/// to be quicker.
class CATENA_API PlannedSearch {
 public:
  /// `alone`: no rival is tried.
  PlannedSearch(const Omissions& omissions, bool alone) : omissions_(omissions), alone_(alone) {}

  /// Plans the search of this chain, or of this next frame, of which nothing is built yet.
  void begin(const Chain& chain, const Request& request, bool frame);
  /// To be told at the end of a build or update: it did not fail.
  void begun(const Chain& chain) { spheres_ = chain.size(); }
  /// Of the last build or update; none where that failed.
  const std::optional<std::uint32_t>& spheres() const { return spheres_; }
  /// None before the first chain, and where planning failed.
  const SearchPlan* plan() const { return plan_ ? &*plan_ : nullptr; }

  void build(const Chain& chain) { build(chain, request_); }
  /// It stands on the chain of the last begin; else a find builds it.
  bool built() const { return built_; }
  void find(const Chain& chain, const Request& request, Collisions& result);
  /// Of another chain: then nothing is built any more. It may be of the same spheres, only thicker.
  void find_other(const Chain& chain, const Request& request, Collisions& result);

  /// Who built last; only where there is such a one.
  Variant& searcher() const { return *searcher_; }
  /// The name of who built last, or is to.
  std::string answered_by() const {
    return searcher_ != nullptr ? plan_->named(searcher_is_) : plan_->variant_with_threads();
  }
  /// What the plan chose, and who took its place.
  Plan steps() const;

 private:
  bool plan_holds(const ChainView& chain, bool frame);
  void build(const Chain& chain, const Request& request);
  void learn(const Chain& chain, Request::Want want);
  template <class Work>
  void with_room(const Work& work);
  bool gives_way(const std::string& why);
  bool rival_gives_way();
  void forget(const Rivals::Contender& who);
  Variant& held(const Rivals::Contender& who);

  const Omissions omissions_;
  const bool alone_;
  Request request_;  ///< of the last begin
  std::optional<SearchPlan> plan_;
  unsigned since_look_ = 0;  ///< frames since it was looked of which kind the chain is
  SearchHistory history_;
  struct Held {
    Rivals::Contender who;
    std::unique_ptr<Variant> variant;
  };
  std::vector<Held> held_;
  Rivals rivals_;
  Rivals::Contender searcher_is_;    ///< of the last build
  std::uint64_t turn_ = 0;           ///< of rivals_, then
  bool planned_ = true;              ///< it is the planned one
  bool told_ = false;                ///< what that took
  bool built_ = false;               ///< the searcher, on the chain of the last begin
  Variant* searcher_ = nullptr;      ///< of held_
  std::uint64_t topology_ = 0;       ///< of the last begin; see ChainView
  const Variant* stands_ = nullptr;  ///< that whose last build was of an earlier frame of the same spheres
  std::optional<std::uint32_t> spheres_;
};

}  // namespace catena

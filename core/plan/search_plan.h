#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/plan/machine.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/plan/rivals.h"
#include "catena/core/plan/search_history.h"
#include "catena/core/plan/unusual_kind.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// How one chain is searched from nothing: by which variant, what is left out, and why. Choosing compares a
/// few numbers and takes no memory; the words are made when they are asked for.
class CATENA_API SearchPlan {
 public:
  /// `machine` must outlive this. `chain`: {} where only n is known of it; `history`: of its searches so far.
  /// Throws CapacityError when the machine has the cost of no variant.
  SearchPlan(std::uint32_t n, const Request& request, const Machine& machine, const Omissions& omissions,
             const ChainView& chain = {}, const SearchHistory& history = {});

  /// It would be no other for this chain and request, as far as neither is of another kind and searches take
  /// about what was thought.
  bool holds_for(std::uint32_t n, const Request& request, const ChainView& chain = {},
                 const SearchHistory& history = {}) const {
    return holds_for_frame(n, request, history) && seen_ == look_at(chain);
  }
  /// The same of a later frame, which is taken to be of the same kind.
  bool holds_for_frame(std::uint32_t n, const Request& request, const SearchHistory& history) const {
    return n == n_ && request.want == asked_ && request.frames_follow == frames_follow_ &&
           is_true_to(history);
  }
  /// Says what building and searching took by this plan; nothing of a device, and of few spheres.
  void tell(double took_ms, SearchHistory& history) const;

  const std::string& variant() const {
    return !in_parts_.empty() ? in_parts_ : kind_ != nullptr ? kind_->variant : chosen_->variant;
  }
  /// Host threads that it is to have; 1 where it knows none.
  unsigned threads() const { return threads_; }
  /// As StrategyRegistry::make takes it: what was chosen, or another in its place.
  std::string variant_with_threads() const { return named({variant(), threads()}); }
  std::string named(const Rivals::Contender& contender) const;
  /// Who might be quicker than what was chosen; nobody on a device, or than what compares all pairs.
  std::vector<Rivals::Contender> rivals(const Extent& extent) const;
  /// Nobody is quicker than a search that takes less: of a usual chain, whose order tells all.
  double worth_trying_ms() const;
  bool on_device() const { return chosen_->on_device; }
  bool all_pairs() const { return chosen_->all_pairs; }
  /// About what build and find take by the usual variant; what another takes of an unusual kind of chain is
  /// not known.
  double estimate_ms() const { return ms(*chosen_, threads()); }
  /// Yes or no is asked, and the likeliest places are to be looked at before anything is built.
  bool look_first() const { return look_first_; }
  /// To be told when there is no room for what variant() does, and why: of a device, first a variant takes
  /// its place that has the chain come in parts, then one of the host. False: there is no other.
  bool give_way(const std::string& why);
  /// What is searched for where this is asked: more where an omission is switched off.
  Request::Want searched_for(Request::Want asked) const;
  Request::Want want() const { return want_; }  ///< of the request that was planned

  Plan steps() const;

 private:
  using Candidate = const Machine::VariantCost*;
  /// What a variant would take with as many threads as pay.
  struct Offer {
    Candidate of = nullptr;
    unsigned threads = 1;
    double ms = std::numeric_limits<double>::infinity();
  };
  void choose();
  void give_to_host();  ///< the tree, or another for which the chain's kind asks
  bool team_pays(const Machine::VariantCost& v) const;
  unsigned threads_that_pay(const Machine::VariantCost& v) const;
  unsigned best_threads(const Machine::VariantCost& v) const;  ///< and can be started
  Offer offer_of(const Machine::VariantCost& v) const;
  double ms(const Machine::VariantCost& v, unsigned threads = 1) const;
  std::string priced(const Machine::VariantCost& v, unsigned threads = 1) const;
  bool pays(const Machine::VariantCost& device, double lost_ms) const {
    return saved_ms_ > 0 && device.start_ms() <= saved_ms_ + lost_ms;
  }
  bool is_true_to(const SearchHistory& history) const;
  const UnusualKind* look_at(const ChainView& chain) const;
  Decision hierarchy() const;
  Decision further_threads() const;
  Decision device() const;

  std::uint32_t n_;
  Request::Want asked_, want_;
  bool frames_follow_;
  const Machine& machine_;
  Omissions omissions_;
  Candidate tree_ = nullptr, all_pairs_ = nullptr,
            device_ = nullptr;  ///< cheapest of a kind; null: there is none
  Candidate chosen_ = nullptr;
  std::string in_parts_;  ///< has the chain come in parts, as the chosen one had no room; empty: it has
  std::string gave_way_;  ///< who had no room, and why
  const UnusualKind* seen_ = nullptr;  ///< the chain's; null: a usual one, or not looked at
  const UnusualKind* kind_ = nullptr;  ///< the same where its variant takes the tree's place
  double times_ = 1;                   ///< about what a sphere takes a host, of what is usual
  double lost_ms_ = 0;                 ///< see SearchHistory
  double saved_ms_ = 0;                ///< of a search on the host, by one on a device that has been started
  unsigned threads_ = 1;               ///< of what was chosen
  bool look_first_ = false;
};

/// What `auto` will do for the first frame of this chain.
CATENA_API Plan plan(const ChainView& chain, const Request& request, const Machine& machine = Machine::here(),
                     const Omissions& omissions = {});

}  // namespace catena

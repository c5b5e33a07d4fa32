#pragma once
#include <cstdint>
#include <string>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/plan/machine.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// How one chain is searched from nothing: by which variant, what is left out, and why. Choosing compares a
/// few numbers and takes no memory; the words are made when they are asked for.
class CATENA_API SearchPlan {
 public:
  /// `machine` must outlive this. Throws CapacityError when it has the cost of no variant.
  SearchPlan(std::uint32_t n, const Request& request, const Machine& machine, const Omissions& omissions);

  const std::string& variant() const { return chosen_->variant; }
  bool on_device() const { return chosen_->on_device; }
  bool all_pairs() const { return chosen_->all_pairs; }
  /// About what build and find take.
  double estimate_ms() const { return chosen_->cost.ms(n_); }
  /// Yes or no is asked, and the likeliest places are to be looked at before anything is built.
  bool look_first() const { return look_first_; }
  /// What is searched for where this is asked: more where an omission is switched off.
  Request::Want searched_for(Request::Want asked) const;
  Request::Want want() const { return want_; }  ///< of the request that was planned

  Plan steps() const;

 private:
  using Candidate = const Machine::VariantCost*;
  Decision hierarchy() const;
  Decision device() const;

  std::uint32_t n_;
  Request::Want asked_, want_;
  const Machine& machine_;
  Omissions omissions_;
  Candidate tree_ = nullptr, all_pairs_ = nullptr,
            device_ = nullptr;  ///< cheapest of a kind; null: there is none
  Candidate chosen_ = nullptr;
  bool look_first_ = false;
};

/// What `auto` will do for the first frame of this chain.
CATENA_API Plan plan(const ChainView& chain, const Request& request, const Machine& machine = Machine::here(),
                     const Omissions& omissions = {});

}  // namespace catena

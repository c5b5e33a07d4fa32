#include "catena/core/plan/search_plan.h"

#include <fmt/format.h>

#include "catena/core/error.h"
#include "catena/core/plan/coarse_look.h"

namespace catena {
namespace {

std::string priced(const Machine::VariantCost& v, std::uint32_t n) {
  return fmt::format("{} about {:.3g} ms", v.variant, v.cost.ms(n));
}

/// "; it may not be left out"
std::string switched_off(const Omissions& omissions, Omission omission) {
  return omissions.may(omission) ? "" : fmt::format("; --no-omit {}", info_of(omission).name);
}

}  // namespace

SearchPlan::SearchPlan(std::uint32_t n, const Request& request, const Machine& machine,
                       const Omissions& omissions)
    : n_(n), asked_(request.want), want_(request.want), machine_(machine), omissions_(omissions) {
  const auto offer = [n](Candidate& best, const Machine::VariantCost& v) {
    if (best == nullptr || v.cost.ms(n) < best->cost.ms(n)) best = &v;
  };
  for (const Machine::VariantCost& v : machine.costs)
    offer(v.on_device ? device_ : v.all_pairs ? all_pairs_ : tree_, v);
  chosen_ = tree_;
  if (chosen_ == nullptr || (all_pairs_ != nullptr && omissions.may(Omission::hierarchy) &&
                             all_pairs_->cost.ms(n) < chosen_->cost.ms(n)))
    chosen_ = all_pairs_;
  if (device_ != nullptr &&
      (chosen_ == nullptr || !omissions.may(Omission::device) || device_->cost.ms(n) < chosen_->cost.ms(n)))
    chosen_ = device_;
  if (chosen_ == nullptr) throw CapacityError("no variant says what it costs, so that none can be planned");
  want_ = searched_for(asked_);
  look_first_ = want_ == Request::Want::any && omissions.may(Omission::other_places) && CoarseLook::pays(n);
}

Request::Want SearchPlan::searched_for(Request::Want asked) const {
  if (asked == Request::Want::any && !omissions_.may(Omission::after_hit)) asked = Request::Want::counts;
  if (asked == Request::Want::counts && !omissions_.may(Omission::pair_list)) asked = Request::Want::pairs;
  return asked;
}

Decision SearchPlan::hierarchy() const {
  const bool out = chosen_ == all_pairs_;
  std::string reason = fmt::format("{} spheres: ", n_);
  if (all_pairs_ == nullptr || tree_ == nullptr) {
    reason += priced(*chosen_, n_);
  } else {
    reason += fmt::format("{}, {}", priced(*tree_, n_), priced(*all_pairs_, n_));
  }
  return {"hierarchy", out, reason + switched_off(omissions_, Omission::hierarchy),
          tree_ != nullptr ? std::optional(tree_->cost.ms(n_)) : std::nullopt};
}

Decision SearchPlan::device() const {
  if (device_ == nullptr) return {"device", true, "none that is available says what it costs"};
  const Candidate host = tree_ != nullptr ? tree_ : all_pairs_;
  return {"device", chosen_ != device_,
          (host != nullptr ? fmt::format("{}, {}", priced(*device_, n_), priced(*host, n_))
                           : priced(*device_, n_)) +
              switched_off(omissions_, Omission::device),
          device_->cost.ms(n_)};
}

Plan SearchPlan::steps() const {
  using enum Request::Want;
  Plan plan{{"choice of variant", false, variant() + " by " + machine_.source, estimate_ms()}};
  plan.push_back(hierarchy());
  plan.push_back(device());
  const bool list = want_ == pairs;
  plan.push_back({"pair list", !list,
                  (asked_ == pairs    ? "pairs are asked for"
                   : asked_ == counts ? "only counts are asked for"
                                      : "only yes or no is asked for") +
                      (list && asked_ != pairs ? switched_off(omissions_, Omission::pair_list) : "")});
  if (asked_ != any) return plan;
  plan.push_back({info_of(Omission::after_hit).step, want_ == any,
                  "one pair is the answer yes" + switched_off(omissions_, Omission::after_hit)});
  plan.push_back({info_of(Omission::other_places).step, look_first_,
                  (look_first_ ? fmt::format("a look at every {}th sphere first, {} of {}",
                                             CoarseLook::stretch, n_ / CoarseLook::stretch, n_)
                               : fmt::format("{} spheres: a look pays from {} on", n_, CoarseLook::least)) +
                      switched_off(omissions_, Omission::other_places)});
  return plan;
}

Plan plan(const ChainView& chain, const Request& request, const Machine& machine,
          const Omissions& omissions) {
  return SearchPlan(chain.size, request, machine, omissions).steps();
}

}  // namespace catena

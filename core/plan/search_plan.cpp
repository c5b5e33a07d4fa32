#include "catena/core/plan/search_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/executor/startable_threads.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/part_look.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/variant_name.h"

namespace catena {
namespace {

/// The strategy of that name takes this parameter.
bool knows(const std::string& variant, const char* parameter) {
  const StrategyInfo* const info =
      StrategyRegistry::instance().find_strategy(VariantName::parse(variant).stages.front().strategy);
  return info != nullptr &&
         std::ranges::find(info->parameters, parameter, &ParameterInfo::name) != info->parameters.end();
}

/// What a strategy leaves out by itself, and the parameter that has it do so all the same.
struct StrategyKeeps {
  Omission omission;
  const char *parameter, *value;
};
constexpr StrategyKeeps strategies_keep[] = {
    {Omission::straight, "rows", "search"},       {Omission::exact, "exact", "all"},
    {Omission::radii, "radii", "each"},           {Omission::strands, "strands", "read"},
    {Omission::range_checks, "range", "checked"}, {Omission::upload, "upload", "all"}};

/// Further threads are to save as much, over what they take to come together: twice that.
double least_saved_ms(const Machine::VariantCost& v) { return 2 * v.cost.team_us * 1e-3; }

/// "; it may not be left out"
std::string switched_off(const Omissions& omissions, Omission omission) {
  return omissions.may(omission) ? "" : fmt::format("; --no-omit {}", info_of(omission).name);
}

}  // namespace

SearchPlan::SearchPlan(std::uint32_t n, const Request& request, const Machine& machine,
                       const Omissions& omissions, const ChainView& chain, const SearchHistory& history)
    : n_(n),
      asked_(request.want),
      want_(request.want),
      frames_follow_(request.frames_follow),
      machine_(machine),
      omissions_(omissions),
      lost_ms_(history.lost_ms()) {
  const double measured = history.times(n);
  if (measured > 0) times_ = measured;
  choose();
  seen_ = look_at(chain);
  if (seen_ != nullptr && seen_->times != 1 && measured == 0) {
    times_ = seen_->times;
    choose();
  }
  if (chosen_ == all_pairs_) seen_ = nullptr;
  if (chosen_ == tree_) give_to_host();
  want_ = searched_for(asked_);
  look_first_ = want_ == Request::Want::any && omissions.may(Omission::other_places) && CoarseLook::pays(n);
}

void SearchPlan::choose() {
  Offer tree, all_pairs, device;  // the cheapest of each kind
  for (const Machine::VariantCost& v : machine_.costs) {
    Offer& best = v.on_device ? device : v.all_pairs ? all_pairs : tree;
    if (const Offer offer = offer_of(v); offer.ms < best.ms) best = offer;
  }
  Offer chosen = tree;
  if (tree.of == nullptr || (omissions_.may(Omission::hierarchy) && all_pairs.ms < tree.ms))
    chosen = all_pairs;
  // To start a device takes a process's first search far longer than most searches. As who rents before he
  // buys, the host goes on until it has lost as much: then no more than twice of what was needed is spent,
  // however many searches come.
  saved_ms_ = chosen.ms - device.ms;
  if (device.of != nullptr &&
      (chosen.of == nullptr || !omissions_.may(Omission::device) || pays(*device.of, lost_ms_))) {
    if (device.of->unavailable && device.of->unavailable())
      device.of = nullptr;
    else
      chosen = device;
  }
  if (chosen.of == nullptr) throw CapacityError("no variant says what it costs, so that none can be planned");
  tree_ = tree.of, all_pairs_ = all_pairs.of, device_ = device.of, chosen_ = chosen.of;
  threads_ = chosen.threads;
}

void SearchPlan::give_to_host() {
  constexpr unsigned few_threads = 4;  // no kind is searched by so much less than several threads take
  if (seen_ == nullptr || (!seen_->threads && threads_ > few_threads)) return;
  kind_ = seen_;
  if (!kind_->threads) threads_ = 1;
}

/// A chain that lies in order is searched in half of what is usual: there a team must not cost more than it
/// saves.
bool SearchPlan::team_pays(const Machine::VariantCost& v) const {
  return ms(v) - ms(v, machine_.cores) >= least_saved_ms(v);
}

/// A greater number takes the place of a lesser one that it beats by a tenth: what is guessed of threads is
/// guessed roughly.
unsigned SearchPlan::threads_that_pay(const Machine::VariantCost& v) const {
  if (v.cost.serial >= 1) return 1;
  if (!omissions_.may(Omission::threads)) return machine_.cores;
  if (!team_pays(v)) return 1;
  unsigned best = 1;
  for (unsigned k = 2; k / 2 < machine_.cores; k *= 2)
    if (const unsigned threads = std::min(k, machine_.cores); ms(v, threads) < 0.9 * ms(v, best))
      best = threads;
  return best;
}

unsigned SearchPlan::best_threads(const Machine::VariantCost& v) const {
  const unsigned pay = threads_that_pay(v);
  return pay > 1 ? 1 + startable_threads(pay - 1) : pay;
}

const UnusualKind* SearchPlan::look_at(const ChainView& chain) const {
  return chosen_ != all_pairs_ && omissions_.may(Omission::threads) ? UnusualKind::of(chain, frames_follow_)
                                                                    : nullptr;
}

double SearchPlan::ms(const Machine::VariantCost& v, unsigned threads) const {
  MachineCost cost = v.cost;
  if (!v.on_device) cost.sphere_ns *= times_;
  return cost.ms(n_, threads);
}

void SearchPlan::tell(double took_ms, SearchHistory& history) const {
  constexpr std::uint32_t few = 2048;             // over before a team has come together
  constexpr double least = 1. / 16, most = 1024;  // a clock may fail
  if (chosen_ != tree_ || n_ <= few) return;
  MachineCost of_spheres = tree_->cost;
  of_spheres.fixed_us = of_spheres.team_us = 0;
  const double others = tree_->cost.fixed_us + (threads_ > 1 ? tree_->cost.team_us : 0);
  const double times = (took_ms - others * 1e-3) / of_spheres.ms(n_, threads_);
  const double lost = device_ != nullptr ? std::max(0.0, took_ms - ms(*device_)) : 0;
  history.add(n_, std::clamp(times, least, most), lost);
}

bool SearchPlan::is_true_to(const SearchHistory& history) const {
  constexpr double about = 1.5;
  if (!gave_way_.empty() || chosen_ != tree_) return true;
  const double times = history.times(n_);
  if (times > about * times_ || (times > 0 && times * about < times_)) return false;
  return device_ == nullptr || !pays(*device_, history.lost_ms());
}

std::string SearchPlan::priced(const Machine::VariantCost& v, unsigned threads) const {
  return fmt::format("{}{} about {:.3g} ms", v.variant,
                     threads > 1 ? fmt::format(" with {} threads", threads) : "", ms(v, threads));
}

SearchPlan::Offer SearchPlan::offer_of(const Machine::VariantCost& v) const {
  const unsigned threads = best_threads(v);
  return {&v, threads, ms(v, threads)};
}

std::string SearchPlan::named(const Rivals::Contender& contender) const {
  const auto& [variant, threads] = contender;
  const auto kept = [&](const auto& k) { return !omissions_.may(k.omission) && knows(variant, k.parameter); };
  if (threads == 1 && std::ranges::none_of(strategies_keep, kept)) return variant;
  VariantName name = VariantName::parse(variant);
  auto& settings = name.stages.front().settings;
  for (const StrategyKeeps& of : strategies_keep)
    if (kept(of)) settings.push_back({of.parameter, of.value});
  if (threads > 1) settings.push_back({"threads", std::to_string(threads)});
  return name.text();
}

std::vector<Rivals::Contender> SearchPlan::rivals(const Extent& extent) const {
  std::vector<Rivals::Contender> all;
  constexpr std::uint32_t most = 1u << 22;  // a trial takes as much memory again
  if (chosen_ != tree_ || tree_ == nullptr || n_ > most) return all;
  // Several threads were guessed to pay; other programs may need the cores.
  if (threads() > 1 && omissions_.may(Omission::threads)) all.push_back({variant(), 1});
  for (const std::string& name : StrategyRegistry::instance().rivals(n_, extent))
    if (name != variant()) all.push_back({name, knows(name, "threads") ? threads() : 1});
  return all;
}

double SearchPlan::worth_trying_ms() const {
  constexpr double some_more = 1.25;
  return tree_ != nullptr ? some_more * tree_->cost.ms(n_, threads()) : 0;
}

bool SearchPlan::give_way(const std::string& why) {
  constexpr const char* parts = "DeviceParts";
  if (!on_device()) return false;
  gave_way_ += fmt::format("; {}: {}", variant(), why);
  const StrategyInfo* const info = StrategyRegistry::instance().find_strategy(parts);
  if (in_parts_.empty() && info != nullptr && !(info->unavailable && info->unavailable())) {
    in_parts_ = parts;
    return true;
  }
  if (tree_ == nullptr && all_pairs_ == nullptr) return false;
  in_parts_.clear();
  chosen_ = tree_ != nullptr ? tree_ : all_pairs_;
  threads_ = best_threads(*chosen_);
  if (chosen_ == tree_) give_to_host();
  return true;
}

Request::Want SearchPlan::searched_for(Request::Want asked) const {
  if (asked == Request::Want::any && !omissions_.may(Omission::after_hit)) asked = Request::Want::counts;
  if (asked == Request::Want::counts && !omissions_.may(Omission::pair_list)) asked = Request::Want::pairs;
  return asked;
}

Decision SearchPlan::hierarchy() const {
  const bool out = chosen_ == all_pairs_;
  std::string reason = counted(n_, "sphere") + ": ";
  if (all_pairs_ == nullptr || tree_ == nullptr) {
    reason += priced(*chosen_);
  } else {
    reason += fmt::format("{}, {}", priced(*tree_), priced(*all_pairs_));
  }
  return {"hierarchy", out, reason + switched_off(omissions_, Omission::hierarchy),
          tree_ != nullptr ? std::optional(ms(*tree_)) : std::nullopt};
}

Decision SearchPlan::device() const {
  if (device_ == nullptr) return {"device", true, "none that is available says what it costs"};
  const Candidate host = tree_ != nullptr ? tree_ : all_pairs_;
  std::string reason = priced(*device_);
  if (host != nullptr) reason += ", " + priced(*host, best_threads(*host));
  if (chosen_ != device_ && saved_ms_ > 0 && device_->start_ms() > 0)
    reason += fmt::format("; to start it about {:.3g} ms, of which {:.3g} were lost so far",
                          device_->start_ms(), lost_ms_);
  if (chosen_ != device_) reason += "; not looked for";
  return {"device", chosen_ != device_, reason + switched_off(omissions_, Omission::device), ms(*device_)};
}

Decision SearchPlan::further_threads() const {
  const std::string step = info_of(Omission::threads).step;
  if (chosen_->cost.serial >= 1 || (kind_ != nullptr && !kind_->threads))
    return {step, true, variant() + " is taken with one"};
  if (machine_.cores == 1) return {step, true, "there is one core"};
  if (threads() < threads_that_pay(*chosen_))
    return {step, threads() == 1,
            fmt::format("no more than {} can be had here of {} that would pay", counted(threads(), "thread"),
                        threads_that_pay(*chosen_))};
  const unsigned other = threads() > 1 ? 1 : 2;
  std::string reason =
      fmt::format("{}, {}; {} cores", priced(*chosen_, threads()), priced(*chosen_, other), machine_.cores);
  if (threads() == 1 && ms(*chosen_, other) < ms(*chosen_))
    reason += team_pays(*chosen_) ? "; that saves less than a tenth"
                                  : fmt::format("; they save less than {:.3g} ms, twice what a team takes",
                                                least_saved_ms(*chosen_));
  return {step, threads() == 1, reason + switched_off(omissions_, Omission::threads),
          ms(*chosen_, std::max(threads(), 2u))};
}

Plan SearchPlan::steps() const {
  using enum Request::Want;
  Plan plan{
      {"choice of variant", false,
       variant_with_threads() + " by " + (kind_ != nullptr ? kind_->reason : machine_.source) + gave_way_,
       variant() == chosen_->variant ? std::optional(estimate_ms()) : std::nullopt}};
  plan.push_back(hierarchy());
  plan.push_back(device());
  plan.push_back(further_threads());
  const bool list = want_ == pairs;
  plan.push_back({"pair list", !list,
                  (asked_ == pairs    ? "pairs are asked for"
                   : asked_ == counts ? "only counts are asked for"
                                      : "only yes or no is asked for") +
                      (list && asked_ != pairs ? switched_off(omissions_, Omission::pair_list) : "")});
  if (asked_ != any) return plan;
  plan.push_back({info_of(Omission::after_hit).step, want_ == any,
                  "one pair is the answer yes" + switched_off(omissions_, Omission::after_hit)});
  plan.push_back(
      {info_of(Omission::other_places).step, look_first_,
       (want_ != any ? "it does not tell all, and all are searched for"
        : look_first_
            ? fmt::format("a look at every {}th sphere first, {} of {}{}", CoarseLook::stretch,
                          n_ / CoarseLook::stretch, n_,
                          PartLook::pays(n_) ? fmt::format(", then at one of {} parts", PartLook::parts) : "")
            : fmt::format("{}: a look pays from {} on", counted(n_, "sphere"), CoarseLook::least)) +
           switched_off(omissions_, Omission::other_places)});
  return plan;
}

Plan plan(const ChainView& chain, const Request& request, const Machine& machine,
          const Omissions& omissions) {
  return SearchPlan(chain.size, request, machine, omissions, chain).steps();
}

}  // namespace catena

#include "catena/bench/regret/regret.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "catena/bench/stability/run.h"
#include "catena/bench/timing/median_interval.h"
#include "catena/bench/timing/sampling.h"
#include "catena/core/error.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"
#include "catena/core/thrown.h"
#include "catena/reference/compare.h"

namespace catena::bench {
namespace {

/// Of this process, all its threads together.
double processor_ms() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
}

/// For all searches, or for each.
enum class Made { once, anew };

/// A variant that stands on a workload's first chain, and gave the right answer.
class Contender {
 public:
  Contender(const std::string& name, const Workload& work, Made made)
      : name_(name), work_(work), chain_(work.chains.front()), made_(made), variant_(work.make(name)) {
    pass();
    const auto comparison = reference::compare(chain_, work.exact.front(), found_);
    if (!comparison.right())
      throw Error(fmt::format("{} on {}: {} pairs missing, {} invented", name, work.label, comparison.missing,
                              comparison.invented));
  }

  /// One sample, of one pass.
  double ms(bool processor) {
    const auto timed = [&](const auto& now) {
      const double before = now();
      for (std::size_t k = 0; k < passes_; ++k) pass();
      return (now() - before) / static_cast<double>(passes_);
    };
    const Stopwatch watch;
    return processor ? timed(processor_ms) : timed([&] { return watch.ms(); });
  }
  /// Its time, by which a sample has as many passes from now on as take about least_ms.
  double try_out(bool processor, double least_ms) {
    double once = ms(processor);
    while (once * static_cast<double>(passes_) < least_ms) passes_ *= 2, once = ms(processor);
    return once;
  }

  /// Until what it took before has told it what to take.
  void settle() {
    constexpr int searches = 40;
    for (int k = 0; k < searches; ++k) pass();
  }
  /// Who mostly does it: others are tried now and then, for fewer searches in a row than they are apart.
  std::string mostly_by() {
    constexpr int searches = 7;
    std::map<std::string, int> times;
    for (int k = 0; k < searches; ++k) pass(), ++times[variant_->answered_by()];
    return std::ranges::max_element(times, {}, [](const auto& of) { return of.second; })->first;
  }

  const std::string& name() const { return name_; }
  const Variant& variant() const { return *variant_; }

 private:
  void pass() {
    if (made_ == Made::anew) variant_.reset(), variant_ = work_.make(name_);
    variant_->build(chain_);
    variant_->find(chain_, {}, found_);
  }

  std::string name_;
  const Workload& work_;
  const Chain& chain_;
  const Made made_;
  std::unique_ptr<Variant> variant_;
  Collisions found_;
  std::size_t passes_ = 1;
};

double median(const std::vector<double>& ms) { return median_interval(ms).median; }

/// Samples of each, in random turns.
std::vector<std::vector<double>> in_turns(const std::vector<Contender*>& contenders, bool processor,
                                          std::size_t rounds, const RegretEffort& effort) {
  std::vector<std::function<double()>> runs;
  for (Contender* c : contenders)
    runs.emplace_back([=] { return blaming(c->name(), [&] { return c->ms(processor); }); });
  return interleave(runs, rounds, effort.seconds, effort.seed);
}

/// One thread of the host does it all.
bool alone(const Variant& planned) {
  const Plan plan = planned.plan();
  return std::ranges::all_of(plan, [](const Decision& step) {
    const bool elsewhere =
        step.step == info_of(Omission::threads).step || step.step == info_of(Omission::device).step;
    return step.left_out || !elsewhere;
  });
}

/// Null when it refuses the chain.
std::unique_ptr<Contender> contender(const std::string& name, const Workload& work, Made made = Made::once) {
  try {
    return blaming(name, [&] { return std::make_unique<Contender>(name, work, made); });
  } catch (const CapacityError&) {
    return nullptr;
  }
}

/// The quickest, by its median after a few turns of those that took less than twice the least when they were
/// tried.
std::unique_ptr<Contender> quickest(const std::vector<VariantInfo>& variants, const Workload& work,
                                    bool processor, const RegretEffort& effort) {
  constexpr std::uint32_t most_all_pairs = 4096;  // beyond, none is the quickest
  std::vector<std::pair<double, std::unique_ptr<Contender>>> tried;
  double least = std::numeric_limits<double>::infinity();
  for (const VariantInfo& v : variants) {
    if (v.all_pairs && work.chains.front().size() > most_all_pairs) continue;
    auto c = contender(v.name, work);
    if (c == nullptr) continue;
    const double ms = c->try_out(processor, effort.least_ms);
    least = std::min(least, ms);
    tried.emplace_back(ms, std::move(c));
    std::erase_if(tried, [&](const auto& t) { return t.first > 2 * least; });
  }
  if (tried.empty()) return nullptr;
  std::vector<Contender*> few;
  for (const auto& [ms, c] : tried) few.push_back(c.get());
  const auto ms = in_turns(few, processor, std::max<std::size_t>(5, effort.rounds / 2), effort);
  return std::move(
      tried[static_cast<std::size_t>(std::ranges::min_element(ms, {}, median) - ms.begin())].second);
}

}  // namespace

double Regret::first_median() const { return median(first_ms); }
double Regret::best_first_median() const { return median(best_first_ms); }
double Regret::auto_median() const { return median(auto_ms); }
double Regret::best_median() const { return median(best_ms); }

std::vector<VariantInfo> regret_variants(std::vector<VariantInfo> all) {
  std::erase_if(all, [](const VariantInfo& v) {
    const bool emulated = std::ranges::any_of(
        v.parts.stages, [](const auto& stage) { return stage.strategy.ends_with("@host"); });
    return !v.exact || v.unavailable || v.on_device() || v.hidden || emulated || v.name == "auto";
  });
  return all;
}

Regret regret(const WorkloadSpec& spec, const std::vector<VariantInfo>& others, const RegretEffort& effort,
              const std::string& of) {
  constexpr double most_overlaps = 2e7;  // beyond, every variant does little but write pairs
  Regret result{.input = label_of(spec)};
  try {
    const auto animation = open_input(spec.input, spec.options).animation;
    const Chain chain = animation->frame(animation->frames() / 2);
    result.n = chain.size();
    if (const double overlaps = estimated_overlaps(chain); overlaps > most_overlaps)
      result.left_out = fmt::format("about {:.0e} spheres overlap", overlaps);
  } catch (const InputError& why) {  // a simulated scene may not get that far at every size
    result.left_out = why.what();
  }
  if (!result.left_out.empty()) return result;
  const auto work = workload(spec);
  const auto fresh = contender(of, *work, Made::anew), settled = contender(of, *work);
  result.left_out = of + " refuses it";
  if (fresh == nullptr || settled == nullptr) return result;
  settled->settle();
  const auto both_alone = [&] { return alone(fresh->variant()) && alone(settled->variant()); };
  // What it takes may still change its mind, and time of the processor is no measure of several threads.
  for (result.processor = both_alone();; result.processor = false) {
    const auto best = quickest(others, *work, result.processor, effort);
    result.left_out = "no other variant takes it";
    if (best == nullptr) return result;
    const auto best_fresh = contender(best->name(), *work, Made::anew);
    result.left_out = best->name() + " refuses it when made anew";
    if (best_fresh == nullptr) return result;
    result.left_out.clear();
    const std::vector<Contender*> all{fresh.get(), best_fresh.get(), settled.get(), best.get()};
    for (Contender* const c : {fresh.get(), best_fresh.get(), settled.get()})
      c->try_out(result.processor, effort.least_ms);
    auto ms = in_turns(all, result.processor, effort.rounds, effort);
    result.first = fresh->variant().answered_by();
    result.chosen = settled->mostly_by();
    result.best = best->name();
    result.first_ms = std::move(ms[0]), result.best_first_ms = std::move(ms[1]);
    result.auto_ms = std::move(ms[2]), result.best_ms = std::move(ms[3]);
    if (!result.processor || both_alone()) return result;
  }
}

std::vector<WorkloadSpec> all_scenes(std::uint32_t n) {
  std::vector<WorkloadSpec> specs;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes())
    specs.push_back({fmt::format("{}:n={}", scene.name, n)});
  return specs;
}

nlohmann::ordered_json to_json(const Regret& regret) {
  return {{"input", regret.input},
          {"first", regret.first},
          {"chosen", regret.chosen},
          {"best", regret.best},
          {"clock", regret.processor ? "processor" : "wall"},
          {"first_ms", regret.first_ms},
          {"best_first_ms", regret.best_first_ms},
          {"auto_ms", regret.auto_ms},
          {"best_ms", regret.best_ms}};
}

}  // namespace catena::bench

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/plan/search_plan.h"
#include "catena/core/plan/test_plan.h"

namespace catena {
namespace {

using Variant = Machine::VariantCost;
using test::step;

/// What a plan is to do, computed a second time: as the page of it says, from the figures alone.
struct Rules {
  std::uint32_t n;
  const Machine& machine;
  const Omissions& omissions;
  double times, lost_ms;  ///< as the history tells; times 0: nothing is known

  struct Choice {
    const Variant* variant = nullptr;
    unsigned threads = 1;
    double ms = std::numeric_limits<double>::infinity();
  };

  /// Microseconds of the spheres and pairs alone, as they are usual.
  double work_us(const Variant& v, unsigned threads) const {
    const double count = n, serial = threads > 1 ? v.cost.serial + (1 - v.cost.serial) / threads : 1;
    return 1e-3 * (v.cost.sphere_ns * count * serial + v.cost.sphere_pair_ns * count * (count - 1) / 2);
  }
  double besides_us(const Variant& v, unsigned threads) const {
    return v.cost.fixed_us + (threads > 1 ? v.cost.team_us : 0);
  }
  double ms(const Variant& v, unsigned threads) const {
    Variant of = v;
    if (times > 0 && !v.on_device) of.cost.sphere_ns *= times;
    return (besides_us(of, threads) + work_us(of, threads)) / 1000;
  }
  unsigned threads(const Variant& v) const {
    if (v.cost.serial == 1) return 1;
    if (!omissions.may(Omission::threads)) return machine.cores;
    if (ms(v, 1) < ms(v, machine.cores) + 2 * v.cost.team_us / 1000) return 1;
    std::vector<unsigned> numbers;
    for (unsigned k = 1; k < machine.cores; k *= 2) numbers.push_back(k);
    numbers.push_back(machine.cores);
    unsigned best = 1;
    for (const unsigned k : numbers)
      if (ms(v, k) < 0.9 * ms(v, best)) best = k;
    return best;
  }
  Choice cheapest(bool on_device, bool all_pairs) const {
    Choice best;
    for (const Variant& v : machine.costs)
      if (v.on_device == on_device && v.all_pairs == all_pairs)
        if (const double takes = ms(v, threads(v)); takes < best.ms) best = {&v, threads(v), takes};
    return best;
  }
  /// On the host; what a device would save is `saved`.
  Choice on_host() const {
    const Choice tree = cheapest(false, false), pairs = cheapest(false, true);
    const bool pairs_pay = omissions.may(Omission::hierarchy) && pairs.ms < tree.ms;
    return tree.variant == nullptr || pairs_pay ? pairs : tree;
  }
  bool device_pays() const {
    const Choice device = cheapest(true, false), host = on_host();
    if (device.variant == nullptr) return false;
    const double saved = host.ms - device.ms;
    return saved > 0 && device.variant->start_ms() <= saved + lost_ms;
  }
  Choice choice() const {
    const Choice device = cheapest(true, false), host = on_host();
    const bool wanted = device.variant != nullptr && !omissions.may(Omission::device);
    return host.variant == nullptr || wanted || device_pays() ? device : host;
  }
};

/// The last two searches of as many spheres, and all that was lost.
struct Told {
  std::vector<std::pair<std::uint32_t, double>> searches;
  double lost_ms = 0;
  double times(std::uint32_t n) const {
    const std::size_t k = searches.size();
    if (k < 2 || searches[k - 1].first != n || searches[k - 2].first != n) return 0;
    return std::min(searches[k - 1].second, searches[k - 2].second);
  }
};

class Made {
 public:
  explicit Made(unsigned seed) : dice_(seed) {
    const auto some = [&](const char* name, bool on_device, bool all_pairs) {
      for (unsigned k = below(3); k > 0; --k) {
        Variant v{
            .variant = name + std::to_string(k), .cost = {}, .on_device = on_device, .all_pairs = all_pairs};
        v.cost.fixed_us = power(0, 2), (all_pairs ? v.cost.sphere_pair_ns : v.cost.sphere_ns) = power(0, 2);
        if (on_device) v.cost.start_ms = power(-1, 3), v.started = [is = below(2) == 0] { return is; };
        if (!on_device && !all_pairs && below(3) > 0)
          v.cost.serial = below(100) / 100., v.cost.team_us = power(0, 3);
        machine.costs.push_back(v);
      }
    };
    some("tree", false, false), some("pairs", false, true), some("device", true, false);
    if (machine.costs.empty()) machine.costs.push_back({"tree", {{1, 1}}});
    machine.cores = 1 + below(20);
    std::vector<std::string> kept;
    for (const char* name : {"hierarchy", "device", "threads"})
      if (below(4) == 0) kept.push_back(name);
    omissions = Omissions::without(kept);
  }
  unsigned below(unsigned limit) { return static_cast<unsigned>(dice_() % limit); }
  double power(double low, double high) {
    return std::pow(10, std::uniform_real_distribution<double>(low, high)(dice_));
  }
  std::uint32_t spheres() { return below(8) == 0 ? 2047 + below(3) : std::uint32_t(power(0, 7)); }

  Machine machine{{}, "a test", {}};
  Omissions omissions;

 private:
  std::mt19937 dice_;
};

TEST(SearchPlan, IsThatOfItsRulesForAnyMachineAndHistory) {
  std::size_t several_threads = 0, devices = 0, learnt = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    Made made(seed);
    const Machine& machine = made.machine;
    SearchHistory history;
    Told told;
    std::uint32_t n = made.spheres();
    for (int search = 0; search < 5; ++search) {
      if (made.below(6) == 0) n = made.spheres();
      const Rules rules{n, machine, made.omissions, told.times(n), told.lost_ms};
      const Rules::Choice expected = rules.choice();
      SearchPlan plan(n, {}, machine, made.omissions, {}, history);
      ASSERT_NEAR(history.times(n), told.times(n), 1e-9 * told.times(n)) << seed;
      ASSERT_EQ(plan.variant(), expected.variant->variant) << seed;
      ASSERT_EQ(plan.threads(), expected.threads) << seed;
      EXPECT_NEAR(plan.estimate_ms(), expected.ms, 1e-9 * expected.ms) << seed;
      several_threads += plan.threads() > 1, devices += plan.on_device(), learnt += rules.times > 0;

      const Plan steps = plan.steps();
      if (expected.variant->cost.serial < 1 && machine.cores > 1) {
        EXPECT_NEAR(*step(steps, "further threads").estimate_ms,
                    rules.ms(*expected.variant, std::max(2u, expected.threads)), 1e-6 * expected.ms)
            << seed;
      }
      const Rules::Choice device = rules.cheapest(true, false);
      const bool waits = !plan.on_device() && device.ms < expected.ms && device.variant->start_ms() > 0;
      EXPECT_EQ(step(steps, "device").reason.find("to start it about") != std::string::npos, waits) << seed;

      // A tree of many spheres tells what it took.
      const double took = plan.estimate_ms() * made.power(-2, 2);
      plan.tell(took, history);
      if (!plan.on_device() && !plan.all_pairs() && n > 2048) {
        const double spheres_us = 1000 * took - rules.besides_us(*expected.variant, expected.threads);
        told.searches.push_back(
            {n, std::clamp(spheres_us / rules.work_us(*expected.variant, expected.threads), 1 / 16., 1024.)});
        if (device.variant != nullptr) told.lost_ms += std::max(0., took - device.ms);
      }
      EXPECT_NEAR(history.times(n), told.times(n), 1e-9 * told.times(n)) << seed;
      EXPECT_NEAR(history.lost_ms(), told.lost_ms, 1e-9 * told.lost_ms) << seed;

      // It stands while a sphere takes within half of what was thought, and no device has come to pay.
      const double thought = rules.times > 0 ? rules.times : 1, now = told.times(n);
      const bool of_tree = !plan.on_device() && !plan.all_pairs(),
                 as_thought = now == 0 || (now <= 1.5 * thought && thought <= 1.5 * now);
      const Rules later{n, machine, made.omissions, rules.times, told.lost_ms};
      EXPECT_EQ(plan.holds_for(n, {}, {}, history), !of_tree || (as_thought && !later.device_pays())) << seed;

      // Where a device had no room the host's best goes on, whatever the next searches take.
      if (!plan.on_device() || rules.on_host().variant == nullptr) continue;
      while (plan.on_device()) ASSERT_TRUE(plan.give_way("no room"));
      const Rules::Choice tree = rules.cheapest(false, false),
                          instead = tree.variant != nullptr ? tree : rules.on_host();
      EXPECT_EQ(plan.variant(), instead.variant->variant) << seed;
      EXPECT_EQ(plan.threads(), instead.threads) << seed;
      SearchHistory slow;
      for (int k = 0; k < 2; ++k) slow.add(n, 500, 1e9);
      EXPECT_TRUE(plan.holds_for(n, {}, {}, slow)) << seed;
    }
  }
  EXPECT_GT(several_threads, 1000u);
  EXPECT_GT(devices, 1000u);
  EXPECT_GT(learnt, 500u);
}

TEST(SearchPlan, HoldsForWhatIsAskedWhateverIsSearchedForInItsPlace) {
  Made made(1);
  using enum Request::Want;
  const Omissions all = Omissions::without(omission_names());
  for (const auto want : {any, counts, pairs}) {
    const SearchPlan plan(100, {want}, made.machine, all);
    EXPECT_EQ(plan.want(), pairs);
    for (const auto other : {any, counts, pairs}) EXPECT_EQ(plan.holds_for(100, {other}), want == other);
  }
}

/// Spheres whose squares leave binary32 are searched by one thread where that is no worse than four.
TEST(SearchPlan, TakesAKindOfOneThreadInsteadOfFour) {
  ChainView tiny{};
  tiny.size = 2000, tiny.extent = {1e-20f, 1e-20f, 1, 1};
  for (const unsigned cores : {1u, 2u, 4u, 5u, 16u}) {
    const Machine machine{{{"Hybrid", {{1, 1000}, 0, 1}}}, "a test", {}, cores};
    const SearchPlan plan(2000, {}, machine, {}, tiny);
    const bool kind = cores <= 4;
    EXPECT_EQ(plan.variant(), kind ? "ChainTree" : "Hybrid") << cores;
    EXPECT_EQ(plan.threads(), kind ? 1 : cores) << cores;
  }
}

}  // namespace
}  // namespace catena

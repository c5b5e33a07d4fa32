#include "catena/core/plan/search_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/plan/coarse_look.h"
#include "catena/core/plan/slow_subnormals.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

using Want = Request::Want;

/// All pairs are cheaper up to 40 spheres, the device from 10,000 on.
Machine machine() {
  return {{{"pairs", {{.sphere_pair_ns = 2}}, false, true},
           {"tree", {{.fixed_us = 1.2, .sphere_ns = 9}}},
           {"slow tree", {{.fixed_us = 5, .sphere_ns = 9}}},
           {"device", {{.fixed_us = 82, .sphere_ns = 0.92}}, true}},
          "a test",
          {}};
}
std::string chosen(std::uint32_t n, const std::vector<std::string>& keep = {},
                   const Machine& of = machine()) {
  return SearchPlan(n, {}, of, Omissions::without(keep)).variant();
}
const Decision& step(const Plan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan, name, &Decision::step);
  if (found == plan.end()) throw std::logic_error("no step " + name);
  return *found;
}

TEST(SearchPlan, TakesWhatIsCheapestForTheNumberOfSpheres) {
  for (const std::uint32_t n : {0u, 1u, 2u, 30u}) EXPECT_EQ(chosen(n), "pairs") << n;
  for (const std::uint32_t n : {60u, 1000u, 9000u}) EXPECT_EQ(chosen(n), "tree") << n;
  for (const std::uint32_t n : {11000u, 1u << 30}) EXPECT_EQ(chosen(n), "device") << n;
}

TEST(SearchPlan, LooksForADeviceOnlyWhereItWouldTakeIt) {
  int looks = 0;
  Machine of = machine();
  of.costs.back().unavailable = [&]() -> std::optional<std::string> { return ++looks, "no device"; };
  EXPECT_EQ(chosen(9000, {}, of), "tree");
  EXPECT_EQ(looks, 0);
  EXPECT_NE(step(SearchPlan(9000, {}, of, {}).steps(), "device").reason.find("not looked for"),
            std::string::npos);
  EXPECT_EQ(chosen(11000, {}, of), "tree");
  EXPECT_EQ(chosen(5, {"device"}, of), "pairs");
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(step(SearchPlan(11000, {}, of, {}).steps(), "device").reason,
            "none that is available says what it costs");
}

TEST(SearchPlan, ADeviceWithoutRoomGivesWayToTheHost) {
  const Machine of = machine();
  SearchPlan on_host(9000, {}, of, {}), on_device(11000, {}, of, {});
  EXPECT_FALSE(on_host.give_way("no room"));
  EXPECT_EQ(on_host.variant(), "tree");
  bool once_in_parts = false;
  while (on_device.on_device()) {
    once_in_parts |= on_device.variant() == "DeviceParts";
    ASSERT_TRUE(on_device.give_way("no room"));
  }
  EXPECT_EQ(on_device.variant(), "tree");
  EXPECT_FALSE(on_device.give_way("no room"));
  const StrategyInfo* const parts = StrategyRegistry::instance().find_strategy("DeviceParts");
  EXPECT_EQ(once_in_parts, parts != nullptr && !(parts->unavailable && parts->unavailable()));
  const std::string reason = on_device.steps().front().reason;
  EXPECT_TRUE(
      reason.ends_with(once_in_parts ? "; device: no room; DeviceParts: no room" : "; device: no room"))
      << reason;
}

TEST(SearchPlan, ADeviceWithoutRoomGivesWayToWhatTheChainsKindAsksFor) {
  const Machine of = machine();
  Extent subnormal;
  subnormal.least_radius = subnormal.greatest_radius = 1e-40f, subnormal.sides = 1;
  SearchPlan plan(11000, {}, of, {}, subnormal);
  EXPECT_EQ(plan.variant(), "device");
  while (plan.on_device()) ASSERT_TRUE(plan.give_way("no room"));
  EXPECT_EQ(plan.variant(), subnormals_are_slow() ? "Grid" : "tree");
}

TEST(SearchPlan, GivesWayToNoneWhereThereIsNone) {
  Machine of = machine();
  of.costs.erase(of.costs.begin(), of.costs.end() - 1);
  SearchPlan plan(100, {}, of, {});
  ASSERT_EQ(plan.variant(), "device");
  if (plan.give_way("no room")) {  // in parts, where there is a device
    EXPECT_EQ(plan.variant(), "DeviceParts");
    EXPECT_FALSE(plan.give_way("no room"));
  }
}

/// The figures of each step are those of what it is about, whatever was chosen.
TEST(SearchPlan, SaysOfEachStepWhatItIsAboutTakes) {
  Machine of = machine();
  of.costs[3].cost.start_ms = 300;
  of.costs[3].started = [] { return false; };
  const MachineCost &pairs = of.costs[0].cost, &tree = of.costs[1].cost, &device = of.costs[3].cost;
  for (const std::uint32_t n : {5u, 200u, 11000u}) {
    SearchHistory history;
    history.add(n, 1, 7);
    const Plan plan = SearchPlan(n, {}, of, {}, {}, {}, history).steps();
    EXPECT_EQ(step(plan, "hierarchy").left_out, n == 5) << n;
    EXPECT_EQ(step(plan, "hierarchy").estimate_ms, tree.ms(n)) << n;
    EXPECT_EQ(
        step(plan, "hierarchy").reason,
        fmt::format("{} spheres: tree about {:.3g} ms, pairs about {:.3g} ms", n, tree.ms(n), pairs.ms(n)));
    EXPECT_EQ(step(plan, "device").estimate_ms, device.ms(n)) << n;
    EXPECT_TRUE(step(plan, "device").left_out) << n;
    EXPECT_EQ(
        step(plan, "device").reason,
        fmt::format("device about {:.3g} ms, tree about {:.3g} ms{}; not looked for", device.ms(n),
                    tree.ms(n), n == 11000 ? "; to start it about 300 ms, of which 7 were lost so far" : ""));
  }
  of.costs[3].started = [] { return true; };
  const Decision taken = step(SearchPlan(11000, {}, of, {}).steps(), "device");
  EXPECT_FALSE(taken.left_out);
  EXPECT_EQ(taken.reason,
            fmt::format("device about {:.3g} ms, tree about {:.3g} ms", device.ms(11000), tree.ms(11000)));
}

/// What a strategy leaves out by itself it is told to do.
TEST(SearchPlan, TellsAStrategyWhatMayNotBeLeftOut) {
  Machine of = machine();
  of.costs = {{"Hybrid", {{.fixed_us = 1, .sphere_ns = 10}}}};
  const auto named = [&](const std::vector<std::string>& keep) {
    return SearchPlan(5000, {}, of, Omissions::without(keep)).variant_with_threads();
  };
  EXPECT_EQ(named({}), "Hybrid");
  EXPECT_EQ(named({"straight"}), "Hybrid(rows=search)");
  EXPECT_EQ(named({"exact"}), "Hybrid(exact=all)");
  EXPECT_EQ(named({"radii"}), "Hybrid(radii=each)");
  EXPECT_EQ(named({"straight", "exact", "radii"}), "Hybrid(rows=search,exact=all,radii=each)");
  of.costs[0].variant = "CPU1";  // which knows none of them
  EXPECT_EQ(named({"straight", "exact", "radii"}), "CPU1");
}

TEST(SearchPlan, LooksAtLikelyPlacesWhereThatMayBeLeftOut) {
  const Machine of = machine();
  constexpr std::uint32_t n = CoarseLook::least;
  const auto looks = [&](std::uint32_t spheres, Want want, const std::vector<std::string>& keep) {
    return SearchPlan(spheres, {want}, of, Omissions::without(keep)).look_first();
  };
  EXPECT_TRUE(looks(n, Want::any, {}));
  EXPECT_FALSE(looks(n - 1, Want::any, {}));
  EXPECT_FALSE(looks(n, Want::counts, {}));
  EXPECT_FALSE(looks(n, Want::any, {"other-places"}));
  EXPECT_FALSE(looks(n, Want::any, {"after-hit"}));
}

/// A few spheres are compared all with all, whatever their kind, and threads that must be had are the usual
/// variant's.
TEST(SearchPlan, AsksForTheKindOnlyWhereItMayTakeThePlaceOfTheTree) {
  const Machine of = machine();
  const Chain few = open_input("path1:n=30").animation->frame(0),
              more = open_input("yarn:n=700").animation->frame(0);
  const auto plan = [&](const Chain& chain, const std::vector<std::string>& keep) {
    return SearchPlan(chain.size(), {}, of, Omissions::without(keep), chain.view().extent, chain.spheres());
  };
  const SearchPlan of_few = plan(few, {});
  EXPECT_EQ(of_few.variant(), "pairs");
  EXPECT_TRUE(of_few.holds_for(few.size(), {}, few.view().extent, few.spheres()));
  ASSERT_NE(UnusualKind::of(more.size(), more.view().extent, more.spheres()), nullptr);
  EXPECT_NE(plan(more, {}).variant(), "tree");
  EXPECT_EQ(plan(more, {"threads"}).variant(), "tree");
}

TEST(SearchPlan, DoesWhatMayNotBeLeftOut) {
  EXPECT_EQ(chosen(5, {"hierarchy"}), "tree");
  EXPECT_EQ(chosen(5, {"device"}), "device");
  EXPECT_EQ(chosen(5, {"device", "hierarchy"}), "device");
  Machine without = machine();
  without.costs.pop_back();
  EXPECT_EQ(chosen(1u << 20, {"device"}, without), "tree");
  EXPECT_THROW(chosen(5, {}, Machine{}), CapacityError);
}

TEST(SearchPlan, HoldsForChainsThatWouldBePlannedAlike) {
  const Machine of = Machine::built_in();
  const auto extent = [](const char* input) { return open_input(input).animation->frame(0).view().extent; };
  const Extent crowded = extent("yarn:n=1000"), sparse = extent("path1:n=1000"),
               wide = extent("cluster:n=1000");
  for (const Extent& first : {crowded, sparse, wide, Extent()}) {
    const SearchPlan plan(1000, {}, of, {}, first);
    for (const Extent& other : {crowded, sparse, wide, Extent()})
      EXPECT_EQ(plan.holds_for(1000, {}, other),
                plan.variant() == SearchPlan(1000, {}, of, {}, other).variant());
    EXPECT_FALSE(plan.holds_for(1001, {}, first));
    EXPECT_FALSE(plan.holds_for(1000, {Want::any}, first));
    EXPECT_FALSE(plan.holds_for(1000, {.frames_follow = true}, first));
  }
}

/// One search that knows threads, of which half the work can be shared out.
Machine sixteen_cores() {
  Machine of = machine();
  of.costs = {{"Hybrid", {{.fixed_us = 1, .sphere_ns = 10}, 0.5, 40}}};
  of.cores = 16;
  return of;
}

TEST(SearchPlan, TakesThreadsWhereTheyPayAndNoMoreThanThat) {
  const Machine of = sixteen_cores();
  const auto threads = [&](std::uint32_t n, const std::vector<std::string>& keep = {}) {
    return SearchPlan(n, {}, of, Omissions::without(keep)).threads();
  };
  EXPECT_EQ(threads(100), 1u);
  EXPECT_EQ(threads(1000), 1u) << "10 us of search, and 40 us for a team";
  EXPECT_EQ(threads(100, {"threads"}), 16u);
  unsigned before = 1;
  int ruled_out = 0;
  for (std::uint32_t n = 1000; n < 1u << 30; n += n / 2) {
    const unsigned now = threads(n);
    // Where two would take less and are not taken all the same, it says by which rule.
    const MachineCost& cost = of.costs[0].cost;
    const Decision further = step(SearchPlan(n, {}, of, {}).steps(), "further threads");
    const bool cheaper_all_the_same = now == 1 && cost.ms(n, 2) < cost.ms(n);
    EXPECT_EQ(further.reason.find("; they save less than 0.08 ms, twice what a team takes") !=
                      further.reason.npos ||
                  further.reason.find("; that saves less than a tenth") != further.reason.npos,
              cheaper_all_the_same)
        << further.reason;
    ruled_out += cheaper_all_the_same;
    EXPECT_GE(now, before) << n;
    EXPECT_LE(now, 16u);
    if (now > 1) {
      const double alone = of.costs[0].cost.ms(n), team = of.costs[0].cost.team_us * 1e-3;
      EXPECT_LT(SearchPlan(n, {}, of, {}).estimate_ms(), alone) << n;
      EXPECT_GT((alone - 1e-3) / 2 * of.costs[0].cost.serial, team) << n << ": where half is to be done, too";
    }
    before = now;
  }
  EXPECT_EQ(before, 16u);
  EXPECT_GT(ruled_out, 0);
  EXPECT_EQ(SearchPlan(1u << 24, {}, of, {}).variant_with_threads(), "Hybrid(threads=16)");
  const Plan plan = SearchPlan(1u << 24, {}, of, {}).steps();
  EXPECT_FALSE(step(plan, "further threads").left_out);
  const MachineCost& cost = of.costs[0].cost;
  EXPECT_EQ(step(plan, "further threads").reason,
            fmt::format("Hybrid with 16 threads about {:.3g} ms, Hybrid about {:.3g} ms; 16 cores",
                        cost.ms(1u << 24, 16), cost.ms(1u << 24)));
  EXPECT_NE(step(plan, "choice of variant").reason.find("Hybrid(threads=16)"), std::string::npos);
  EXPECT_TRUE(step(SearchPlan(100, {}, of, {}).steps(), "further threads").left_out);
  Machine one = of;
  one.cores = 1;
  EXPECT_EQ(SearchPlan(1u << 24, {}, one, {}).threads(), 1u);
}

/// Spheres that touch those beside them in a block, in no order: each takes a host several times as long as
/// in a tube.
TEST(SearchPlan, TakesThreadsSoonerWhereMuchIsNear) {
  Machine of = sixteen_cores();
  const auto plan = [&](const ChainView& chain) {
    return SearchPlan(chain.size, {}, of, {}, chain.extent, {chain.spheres, chain.size});
  };
  // A lattice in no order, and in rows that go on elsewhere.
  const auto crowded = [](std::uint32_t row) {
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < 8000; ++k) {
      const std::uint32_t at = k / row * 3001 % (8000 / row) * row + k % row;
      spheres.push_back({static_cast<float>(at % 20), static_cast<float>(at / 20 % 20),
                         static_cast<float>(at / 400), 0.5f});
    }
    return Chain(std::move(spheres));
  };
  for (const auto& [row, variant] : {std::pair(1u, "Hybrid"), {20u, "Grid"}}) {
    const Chain chain = crowded(row);
    EXPECT_EQ(plan(chain.view()).variant(), variant) << row;
    EXPECT_GT(plan(chain.view()).threads(), 1u) << row;
    EXPECT_TRUE(plan(chain.view()).holds_for(8000, {}, chain.view().extent, chain.spheres())) << row;
    EXPECT_GT(plan(chain.view()).estimate_ms(), SearchPlan(8000, {}, of, {}).estimate_ms()) << row;
  }
  EXPECT_EQ(SearchPlan(8000, {}, of, {}).threads(), 1u);
  // What was measured counts more than what such chains take.
  SearchHistory history;
  for (int k = 0; k < 2; ++k) history.add(8000, 2, 0);
  const Chain chain = crowded(1);
  const ChainView view = chain.view();
  EXPECT_EQ(SearchPlan(8000, {}, of, {}, view.extent, {view.spheres, view.size}, history).estimate_ms(),
            SearchPlan(8000, {}, of, {}, Extent(), {}, history).estimate_ms());
}

TEST(SearchPlan, LearnsWhatASphereTakesFromTwoSearches) {
  const Machine of = sixteen_cores();
  constexpr std::uint32_t n = 8000;
  const auto plan = [&](const SearchHistory& history) {
    return SearchPlan(n, {}, of, {}, Extent(), {}, history);
  };
  SearchHistory history;
  ASSERT_EQ(plan(history).threads(), 1u);
  plan(history).tell(1, history);
  EXPECT_EQ(plan(history).threads(), 1u) << "a first search takes longer than those after it";
  EXPECT_TRUE(plan({}).holds_for(n, {}, Extent(), {}, history));
  plan(history).tell(0.9, history);
  EXPECT_FALSE(plan({}).holds_for(n, {}, Extent(), {}, history));
  const SearchPlan crowded = plan(history);
  EXPECT_GT(crowded.threads(), 1u);
  EXPECT_EQ(plan(history).estimate_ms(), crowded.estimate_ms());
  EXPECT_EQ(SearchPlan(n + 1, {}, of, {}, Extent(), {}, history).threads(), 1u) << "of other spheres";
  for (int k = 0; k < 3; ++k) {  // it takes what it was thought to, give or take a fifth
    crowded.tell(crowded.estimate_ms() * (1 + (k - 1) / 5.), history);
    EXPECT_TRUE(crowded.holds_for(n, {}, Extent(), {}, history));
    EXPECT_EQ(plan(history).threads(), crowded.threads());
  }
  crowded.tell(100, history);
  EXPECT_TRUE(crowded.holds_for(n, {}, Extent(), {}, history)) << "one that was disturbed";
  for (int k = 0; k < 2; ++k) crowded.tell(0.06, history);
  EXPECT_FALSE(crowded.holds_for(n, {}, Extent(), {}, history));
  EXPECT_EQ(plan(history).threads(), 1u);
  SearchHistory few;
  for (int k = 0; k < 2; ++k) SearchPlan(1000, {}, of, {}).tell(50, few);
  EXPECT_EQ(few.times(1000), 0);
}

/// A machine whose device takes a tenth of the host's time for many spheres, and 400 ms to start.
struct LateDevice {
  int looks = 0;
  bool started = false;
  Machine machine{{{"tree", {{.fixed_us = 1, .sphere_ns = 10}}},
                   {"device",
                    {{.fixed_us = 80, .sphere_ns = 1, .start_ms = 400}},
                    true,
                    false,
                    [this]() -> std::optional<std::string> { return ++looks, started = true, std::nullopt; },
                    [this] { return started; }}},
                  "a test",
                  {}};
};

TEST(SearchPlan, StartsADeviceWhereAsMuchWasLostWithoutIt) {
  for (const std::uint32_t n : {20'000u, 100'000u, 1'000'000u, 30'000'000u, 1'000'000'000u}) {
    LateDevice late;
    SearchHistory history;
    const double host = 1e-3 + n * 10e-6, device = 80e-3 + n * 1e-6, start = 400;
    double spent = 0;
    bool on_device = false;
    std::optional<SearchPlan> plan;
    for (int searches = 1; searches <= 20000; ++searches) {
      if (!plan || !plan->holds_for(n, {}, Extent(), {}, history)) {
        plan.emplace(n, Request{}, late.machine, Omissions{}, Extent(), std::span<const Sphere>{}, history);
        EXPECT_EQ(late.looks > 0, plan->on_device());
      }
      EXPECT_GE(plan->on_device(), on_device) << "and back";
      if (plan->on_device() && !on_device) spent += start;
      on_device = plan->on_device();
      spent += on_device ? device : host;
      if (!on_device) plan->tell(host, history);
      const double best = std::min(searches * host, start + searches * device);
      ASSERT_LE(spent, 2 * best + host) << n << ", " << searches;
    }
    EXPECT_TRUE(on_device) << n;
    EXPECT_FALSE(step(plan->steps(), "device").left_out);
  }
  LateDevice late;
  const std::string reason = step(SearchPlan(100'000, {}, late.machine, {}).steps(), "device").reason;
  EXPECT_NE(reason.find("to start it about 400 ms"), std::string::npos) << reason;
  EXPECT_EQ(late.looks, 0);
  const SearchPlan before(100'000, {}, late.machine, {});
  late.started = true;  // by others
  EXPECT_FALSE(before.holds_for(100'000, {}, Extent()));
  EXPECT_TRUE(SearchPlan(100'000, {}, late.machine, {}).on_device());
  EXPECT_FALSE(SearchPlan(5'000, {}, late.machine, {}).on_device());
}

TEST(SearchPlan, WeighsTheDeviceAgainstAllCores) {
  Machine of = sixteen_cores();
  of.costs[0].cost.serial = 0.02;
  of.costs.push_back({"device", {{.fixed_us = 82, .sphere_ns = 4}}, true});
  const SearchPlan on_host(1u << 20, {}, of, {});
  EXPECT_EQ(on_host.variant(), "Hybrid");
  const std::string taken = fmt::format(", Hybrid with 16 threads about {:.3g} ms", on_host.estimate_ms());
  EXPECT_NE(step(on_host.steps(), "device").reason.find(taken), std::string::npos) << taken;
  of.cores = 1;
  EXPECT_EQ(SearchPlan(1u << 20, {}, of, {}).variant(), "device");
}

/// The figure of the usual variant is none of another that an unusual kind of chain puts in its place.
TEST(SearchPlan, EstimatesTheVariantThatItNamesOrNone) {
  const Machine of = sixteen_cores();
  std::vector<Sphere> spheres;
  for (int i = 0; i < 2000; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.4f});
  const Chain chain(std::move(spheres));
  const SearchPlan unusual(chain.size(), {}, of, {}, chain.view().extent, chain.spheres());
  const SearchPlan usual(chain.size(), {}, of, {});
  ASSERT_EQ(unusual.variant(), "ChainTree");
  ASSERT_EQ(usual.variant(), "Hybrid");
  EXPECT_EQ(step(unusual.steps(), "choice of variant").estimate_ms, std::nullopt);
  EXPECT_EQ(step(usual.steps(), "choice of variant").estimate_ms, usual.estimate_ms());
  EXPECT_NE(step(unusual.steps(), "hierarchy").reason.find("Hybrid about"), std::string::npos);
}

TEST(SearchPlan, SaysWhatItLeavesOutAndTheFigureThatDecided) {
  const Machine of = machine();
  const Plan plan = SearchPlan(20, {Want::counts}, of, {}).steps();
  EXPECT_TRUE(step(plan, "hierarchy").left_out);
  EXPECT_NE(step(plan, "hierarchy").reason.find("20 spheres"), std::string::npos);
  EXPECT_TRUE(step(plan, "pair list").left_out);
  EXPECT_TRUE(step(plan, "device").left_out);
  const Plan full = SearchPlan(20, {Want::counts}, of, Omissions::without(omission_names())).steps();
  for (const char* name : {"hierarchy", "pair list", "device"})
    EXPECT_FALSE(step(full, name).left_out) << name;
  EXPECT_NE(step(full, "pair list").reason.find("--no-omit pair-list"), std::string::npos);
}

/// Of yes or no it says which steps that spares, and of which none may be spared.
TEST(SearchPlan, SaysWhatYesOrNoSpares) {
  const Machine of = machine();
  const std::string after_hit = info_of(Omission::after_hit).step,
                    places = info_of(Omission::other_places).step;
  const auto steps = [&](std::uint32_t n, const std::vector<std::string>& keep) {
    return SearchPlan(n, {Want::any}, of, Omissions::without(keep)).steps();
  };
  const Plan spared = steps(8192, {}), kept = steps(8192, {"after-hit"});
  EXPECT_TRUE(step(spared, after_hit).left_out);
  EXPECT_EQ(step(spared, "pair list").reason, "only yes or no is asked for");
  EXPECT_TRUE(step(spared, places).left_out);
  EXPECT_EQ(step(spared, places).reason, "a look at every 1024th sphere first, 8 of 8192");
  EXPECT_FALSE(step(kept, after_hit).left_out);
  EXPECT_TRUE(step(kept, after_hit).reason.ends_with("; --no-omit after-hit"));
  EXPECT_FALSE(step(kept, places).left_out);
  EXPECT_EQ(step(kept, places).reason, "it does not tell all, and all are searched for");
  EXPECT_EQ(step(steps(300000, {}), places).reason,
            "a look at every 1024th sphere first, 292 of 300000, then at one of 256 parts");
  EXPECT_EQ(step(steps(100, {}), places).reason, "100 spheres: a look pays from 8192 on");
  EXPECT_THROW(step(SearchPlan(8192, {}, of, {}).steps(), places), std::logic_error);
}

TEST(SearchPlan, HasNoFurtherThreadsOnOneCore) {
  Machine of = sixteen_cores();
  of.cores = 1;
  const Decision threads = step(SearchPlan(1u << 20, {}, of, {}).steps(), "further threads");
  EXPECT_TRUE(threads.left_out);
  EXPECT_EQ(threads.reason, "there is one core");
}

/// A few spheres in no order are sorted once for several frames.
TEST(SearchPlan, OfFramesTakesWhatKeepsAnOrder) {
  std::mt19937 dice(5);
  std::uniform_real_distribution<float> side(0, 30);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 1000; ++i) spheres.push_back({side(dice), side(dice), side(dice), 0.4f});
  const Chain chain(std::move(spheres));
  const auto variant_of = [&](bool frames_follow) {
    return SearchPlan(chain.size(), {.frames_follow = frames_follow}, Machine::here(), {},
                      chain.view().extent, chain.spheres())
        .variant();
  };
  EXPECT_EQ(variant_of(false), "Grid");
  EXPECT_EQ(variant_of(true), "SphereTree");
}

TEST(SearchPlan, EveryOmissionStatesItsObligation) {
  EXPECT_THROW(Omissions::without(std::vector<std::string>{"nonsense"}), std::logic_error);
  std::vector<std::string> names = omission_names();
  std::ranges::sort(names);
  EXPECT_TRUE(std::ranges::adjacent_find(names) == names.end());
  for (const OmissionInfo& o : all_omissions()) {
    EXPECT_FALSE(o.obligation.empty()) << o.name;
    EXPECT_EQ(&info_of(o.omission), &o);
    EXPECT_FALSE(Omissions::without(std::vector{o.name}).may(o.omission)) << o.name;
    EXPECT_TRUE(Omissions().may(o.omission)) << o.name;
  }
}

}  // namespace
}  // namespace catena

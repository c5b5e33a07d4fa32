// Where a plan takes a device, starts it, and gives way to the host.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>

#include "catena/core/plan/search_plan.h"
#include "catena/core/plan/test_plan.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

using test::chosen;
using test::machine;
using test::sixteen_cores;
using test::step;

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
  Machine of = machine();
  of.costs.back().cost.fixed_us = 1;  // a device for few spheres, too
  ChainView tiny{};
  tiny.size = 2000, tiny.extent = {1e-20f, 1e-20f, 1, 1};
  SearchPlan plan(2000, {}, of, {}, tiny);
  EXPECT_EQ(plan.variant(), "device");
  while (plan.on_device()) ASSERT_TRUE(plan.give_way("no room"));
  EXPECT_EQ(plan.variant(), "ChainTree");
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
      if (!plan || !plan->holds_for(n, {}, {}, history)) {
        plan.emplace(n, Request{}, late.machine, Omissions{}, ChainView{}, history);
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
  EXPECT_FALSE(before.holds_for(100'000, {}));
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

}  // namespace
}  // namespace catena

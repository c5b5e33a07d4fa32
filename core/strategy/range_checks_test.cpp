#include "catena/core/strategy/range_checks.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <vector>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/chain/chain.h"

namespace catena {
namespace {

RangeChecks checks(const char* range) { return RangeChecks(Parameters("test", {range_parameter()}, range)); }

template <class Arithmetic>
bool left_out(RangeChecks& of, float radius) {
  const Chain chain(std::vector<Sphere>(3, Sphere{0, 0, 0, radius}));
  bool in_range = false;
  of.with_tests_for<Arithmetic>(
      chain.view(), [&](auto tests) { in_range = std::is_same_v<decltype(tests), Robust::InRange>; });
  return in_range;
}

/// They are where the chain proves them idle, and nobody asks for them all the same.
TEST(RangeChecks, AreLeftOutWhereTheRadiiAllowIt) {
  RangeChecks proved = checks(""), checked = checks("range=checked");
  EXPECT_TRUE(left_out<Robust>(proved, 1));
  EXPECT_FALSE(left_out<Robust>(proved, 1e-20f));
  EXPECT_FALSE(left_out<Robust>(checked, 1));
  EXPECT_FALSE(left_out<Robust>(checked, 1e-20f));
}

TEST(RangeChecks, SayTheRadiiThatDecided) {
  RangeChecks proved = checks(""), checked = checks("range=checked");
  EXPECT_TRUE(proved.plan().empty()) << "nothing was searched";
  const auto told = [](RangeChecks& of, float radius) {
    left_out<Robust>(of, radius);
    const Plan plan = of.plan();
    return (plan.at(0).left_out ? "left out: " : "done: ") + plan.at(0).reason;
  };
  EXPECT_EQ(told(proved, 2),
            "left out: radii from 2 to 2: the sums of two cannot leave binary32's safe range");
  EXPECT_EQ(told(proved, 1e-20f),
            "done: radii from 1e-20 to 1e-20: the sums of two could leave binary32's safe range");
  EXPECT_EQ(
      told(checked, 2),
      "done: radii from 2 to 2: the sums of two cannot leave binary32's safe range; checked all the same");
  EXPECT_EQ(told(checked, 1e-20f), told(proved, 1e-20f)) << "they are due, whoever asks for them";
  const Chain unlike(std::vector<Sphere>{{0, 0, 0, 1}, {3, 0, 0, 4}, {9, 0, 0, 2}});
  proved.with_tests_for<Robust>(unlike.view(), [](auto) {});
  EXPECT_TRUE(proved.plan()[0].reason.starts_with("radii from 1 to 4: ")) << proved.plan()[0].reason;
  left_out<Double>(proved, 2);
  EXPECT_TRUE(proved.plan().empty()) << "it has none";
}

}  // namespace
}  // namespace catena

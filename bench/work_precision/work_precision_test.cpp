#include "catena/bench/work_precision/work_precision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catena/bench/timing/times_told.h"

namespace catena::bench {
namespace {

const std::vector<std::string> variants{"aCPU2+Dual", "aCPU2+Dual/literal", "CPU1"};

const Point& point(const WorkPrecision& result, const std::string& variant, std::size_t n) {
  const auto is_it = [&](const Point& p) { return p.variant == variant && p.n == n; };
  return *std::ranges::find_if(result.points, is_it);
}

TEST(WorkPrecision, FarFromTheOriginRoundedArithmeticHasAnAnswerErrorAndRobustHasNone) {
  const auto near = work_precision(helix(), {800, 3200}, variants, 3),
             far = work_precision(helix(), {800, 3200}, variants, 3, 0x1p20);
  ASSERT_EQ(far.points.size(), 6u);
  for (const auto* result : {&near, &far})
    for (const Point& p : result->points) {
      if (p.arithmetic == "robust") {
        EXPECT_EQ(p.answer_error, 0) << p.variant;
      }
      EXPECT_EQ(p.repetitions, 3u);
      EXPECT_GT(p.time.least, 0);
      EXPECT_LE(p.time.lower, p.time.upper);
      EXPECT_EQ(p.offset, result == &far ? 0x1p20 : 0);
    }
  EXPECT_EQ(point(near, "aCPU2+Dual/literal", 3200).answer_error, 0);
  const Point& lost = point(far, "aCPU2+Dual/literal", 3200);
  EXPECT_GT(lost.missing, 0u);
  EXPECT_EQ(lost.answer_error,
            static_cast<double>(lost.missing + lost.invented) / static_cast<double>(lost.exact_pairs));
  EXPECT_GT(lost.depth_error, 0) << "of the deepest pair that was lost";
  EXPECT_LE(lost.depth_error, 2);
  EXPECT_NEAR(lost.stored_error, 0.0625 * std::sqrt(3), 0.01)
      << "half the spacing of floats at 2^20, on each axis";
  EXPECT_LT(point(near, "CPU1", 3200).stored_error, 1e-5);
  EXPECT_GT(lost.answer_error, 0.01) << "lost by parents that do not enclose";
  const double slope =
      std::log(point(far, "aCPU2+Dual", 800).tube_error / point(far, "aCPU2+Dual", 3200).tube_error) /
      std::log(4);
  EXPECT_NEAR(slope, 2, 0.1);
}

TEST(WorkPrecision, SaysWhatItLeavesOut) {
  const auto result = work_precision(straight_rod(), {6000}, variants, 1);
  EXPECT_EQ(result.points.size(), 2u);
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_TRUE(result.left_out[0].starts_with("CPU1: O(n^2)"));
}

TEST(WorkPrecision, TimesABuildAndNoUpdate) {
  TimesTold::calls.clear();
  const auto result = work_precision(straight_rod(), {20}, {"TimesTold"}, 5);
  ASSERT_EQ(result.points.size(), 1u);
  EXPECT_GE(result.points[0].time.least, TimesTold::slept_ms);
  std::vector<std::string> stages;
  for (const auto& call : TimesTold::calls) stages.push_back(call.stage);
  EXPECT_EQ(std::ranges::count(stages, "update"), 0);
  EXPECT_GE(std::ranges::count(stages, "build"), 5);
}

}  // namespace
}  // namespace catena::bench

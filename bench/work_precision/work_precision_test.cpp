#include "catena/bench/work_precision/work_precision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/timing/test_times_told.h"
#include "catena/bench/tube/error.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"

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

// Computed a second time, of what a rounded variant loses far from the origin; and who beats whom is told.
TEST(WorkPrecision, SaysHowDeepTheDeepestPairLostLies) {
  constexpr double offset = 0x1p20;
  const std::string rounded = "aCPU2+Dual/literal";
  const Tube tube = helix();
  const auto result = work_precision(tube, {3200}, {rounded, "aCPU2+Dual"}, 3, offset);
  const Chain chain = inscribed_chain(tube, 3200, offset);
  const auto variant = StrategyRegistry::instance().make(rounded);
  Collisions found;
  variant->build(chain);
  variant->find(chain, {}, found);
  std::ranges::sort(found.pairs);
  double deepest = 0;
  const auto exact = reference::find(chain).pairs;
  for (const auto* some : {&exact, &std::as_const(found.pairs)})
    for (const Pair& p : *some)
      if (std::ranges::binary_search(exact, p) != std::ranges::binary_search(found.pairs, p)) {
        const Sphere &a = chain[p.i], &b = chain[p.j];
        const double apart = std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
        deepest = std::max(deepest, std::abs(apart - 2 * tube.radius));
      }
  EXPECT_GT(deepest, 0);
  EXPECT_DOUBLE_EQ(point(result, rounded, 3200).depth_error, deepest / tube.radius);
  auto points = result.points;
  for (Point& p : points) p.dominated_by.reset();
  mark_dominated(points);
  for (std::size_t k = 0; k < points.size(); ++k)
    EXPECT_EQ(points[k].dominated_by, result.points[k].dominated_by) << k;
}

TEST(WorkPrecision, MarksWhoIsSlowerForNoLessError) {
  const auto result = work_precision(straight_rod(), {4000}, {"CPU1", "ChainTree"}, 5);
  EXPECT_TRUE(point(result, "CPU1", 4000).dominated_by.has_value());  // 8 million pairs against 4000 spheres
  EXPECT_FALSE(point(result, "ChainTree", 4000).dominated_by.has_value());
}

// An answer that its variant says is exact and is not is no error to measure.
TEST(WorkPrecision, RefusesAVariantThatIsWrongAndSaysItIsExact) {
  EXPECT_THROW(work_precision(helix(), {800}, {"mutant:grid-truncates-toward-zero"}, 1), InputError);
}

TEST(WorkPrecision, SaysWhatItLeavesOut) {
  const auto result = work_precision(straight_rod(), {6000, 7000}, variants, 1);
  EXPECT_EQ(result.points.size(), 4u);
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

#include "catena/bench/work_precision/pareto.h"

#include <gtest/gtest.h>

namespace catena::bench {
namespace {

Point point(double tube_error, double answer_error, double ms) {
  Point p;
  p.tube_error = tube_error, p.answer_error = answer_error;
  p.time = {0.9 * ms, 0.95 * ms, ms, 1.05 * ms};
  return p;
}

TEST(Pareto, TheFrontIsWhatNothingBeatsInEveryWay) {
  std::vector<Point> points{point(0.1, 0, 1),       // 0: fast and coarse
                            point(0.01, 0, 10),     // 1: slow and fine
                            point(0.1, 0, 2),       // 2: as coarse as 0, slower
                            point(0.1, 0.5, 0.5),   // 3: faster, but wrong
                            point(0.01, 0.1, 11)};  // 4: as fine as 1, slower and wrong
  mark_dominated(points);
  EXPECT_FALSE(points[0].dominated_by);
  EXPECT_FALSE(points[1].dominated_by);
  EXPECT_EQ(points[2].dominated_by, 0u);
  EXPECT_FALSE(points[3].dominated_by);
  EXPECT_FALSE(points[4].dominated_by) << "within the spread of 1: not decided";
  points[4] = point(0.01, 0.1, 13);
  mark_dominated(points);
  EXPECT_EQ(points[4].dominated_by, 1u);
}

TEST(Pareto, ADifferenceWithinTheSpreadDecidesNothing) {
  std::vector<Point> points{point(0.1, 0, 1), point(0.1, 0, 1.05)};
  mark_dominated(points);
  EXPECT_FALSE(points[0].dominated_by);
  EXPECT_FALSE(points[1].dominated_by);
}

/// By the quickest of those that do, and anew each time; times that meet at their ends decide nothing.
TEST(Pareto, NamesTheQuickestOfThoseThatBeatIt) {
  std::vector<Point> points{point(0.1, 0, 3), point(0.1, 0, 1), point(0.1, 0, 2), point(0.1, 0, 9)};
  mark_dominated(points);
  EXPECT_EQ(points[3].dominated_by, 1u);
  points[1] = point(0.2, 0, 1);
  mark_dominated(points);
  EXPECT_EQ(points[3].dominated_by, 2u);
  points = {points[3]};
  mark_dominated(points);
  EXPECT_FALSE(points[0].dominated_by);
  points = {point(0.1, 0, 1), point(0.1, 0, 2)};
  points[1].time.lower = points[0].time.upper;
  mark_dominated(points);
  EXPECT_FALSE(points[1].dominated_by);
}

}  // namespace
}  // namespace catena::bench

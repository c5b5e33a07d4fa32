#include "catena/bench/fit/least_squares.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace catena::bench {
namespace {

TEST(LeastSquares, FitsALineAsTheFormulasOfALineDo) {
  // y = a + b x at x = 0, 1, 2, 3: mean of x 3/2, sum of (x - 3/2)^2 5.
  const auto fit = least_squares({{1, 0}, {1, 1}, {1, 2}, {1, 3}}, {1, 3, 4, 8});
  ASSERT_EQ(fit.best.size(), 2u);
  EXPECT_NEAR(fit.best[1], 2.2, 1e-12);
  EXPECT_NEAR(fit.best[0], 0.7, 1e-12);
  EXPECT_NEAR(fit.variance[1], 1.0 / 5, 1e-12);
  EXPECT_NEAR(fit.variance[0], 1.0 / 4 + 2.25 / 5, 1e-12);
  EXPECT_NEAR(fit.rest, 1.8, 1e-12);
}

TEST(LeastSquares, IsExactWhereTheValuesAre) {
  const auto fit = least_squares({{1, 2, 4}, {1, 3, 9}, {1, 5, 25}, {1, 7, 49}}, {1, 6, 22, 46});
  EXPECT_NEAR(fit.best[0], -3, 1e-9);
  EXPECT_NEAR(fit.best[1], 0, 1e-9);
  EXPECT_NEAR(fit.best[2], 1, 1e-9);
  EXPECT_NEAR(fit.rest, 0, 1e-18);
}

TEST(LeastSquares, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(least_squares({}, {}), std::logic_error);
  EXPECT_THROW(least_squares({{1, 2}}, {1}), std::logic_error);
  EXPECT_THROW(least_squares({{1, 2}, {1, 3}}, {1}), std::logic_error);
  EXPECT_THROW(least_squares({{1, 2}, {1}, {1, 3}}, {1, 2, 3}), std::logic_error);
}

}  // namespace
}  // namespace catena::bench

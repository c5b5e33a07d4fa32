// Length, edges and bends of a polygon.
#include "catena/bench/knots/polygon_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "catena/bench/knots/test_knots.h"
#include "catena/core/error.h"

namespace catena::bench {
namespace {

using std::numbers::pi;

TEST(PolygonShape, IsThatOfARegularPolygon) {
  for (const std::uint32_t n : {3u, 4u, 7u, 100u}) {
    const PolygonShape shape = shape_of(ring(n));
    EXPECT_NEAR(shape.length, 2 * n * std::sin(pi / n), 1e-6 * n);
    EXPECT_NEAR(shape.longest_edge, 2 * std::sin(pi / n), 1e-6);
    EXPECT_NEAR(shape.shortest_edge, 2 * std::sin(pi / n), 1e-6);
    EXPECT_NEAR(shape.tightest_bend, std::cos(pi / n),
                1e-4);  // the circle that touches every edge in its middle
    EXPECT_EQ(shape.least_bend, shape.tightest_bend);
    EXPECT_EQ(shape.greatest_bend, shape.tightest_bend);
    const PolygonShape blurred = shape_of(ring(n), 1e-4);
    EXPECT_EQ(blurred.tightest_bend, shape.tightest_bend);
    EXPECT_LT(blurred.least_bend, shape.tightest_bend);
    EXPECT_GT(blurred.greatest_bend, shape.tightest_bend);
  }
}

TEST(PolygonShape, RefusesWhatIsNoClosedPolygon) {
  const auto refused = [](const Chain& chain, const std::string& because) {
    try {
      shape_of(chain);
      ADD_FAILURE() << because;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(because), std::string::npos) << e.what();
    }
  };
  refused(Chain(std::vector<Sphere>{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}), "is open");
  refused(Chain({{0, 0, 0, 0}, {1, 0, 0, 0}}, Strands::one_closed(2)), "fewer than three");
  refused(Chain({{0, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}, Strands::one_closed(3)),
          "vertex 1 lies on the next");
  refused(Chain(), "no vertex");
}

}  // namespace
}  // namespace catena::bench

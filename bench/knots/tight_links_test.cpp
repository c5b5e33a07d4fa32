// Links that are known to be tight.
#include "catena/bench/knots/tight_links.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "catena/bench/knots/polygon_shape.h"
#include "catena/bench/knots/test_knots.h"

namespace catena::bench {
namespace {

using std::numbers::pi;

// Its distances are known: 4 (1 + 2 (1 - cos a)(1 - cos b)) squared, of the angles from the other circle's
// centre.
TEST(TightLinks, HopfLinkHasAsManyStrutsAsVerticesSeeTheOtherCentre) {
  for (const std::uint32_t n : {16u, 24u, 48u}) {
    const TightLink link = hopf_link(n);
    const auto above = static_cast<float>(1 + 2 * link.blur), below = static_cast<float>(1 - 2 * link.blur);
    EXPECT_EQ(contacts_at(*variant(), link.centres, above), 2 * n - 1);
    EXPECT_EQ(contacts_at(*variant(), link.centres, below), 0u);
    const double step = 1 - std::cos(2 * pi / n);  // one step from both centres: the next four pairs
    EXPECT_EQ(contacts_at(*variant(), link.centres,
                          static_cast<float>(std::sqrt(1 + 2 * step * step) + 2 * link.blur)),
              2 * n - 1 + 4);
  }
}

// Half circles of n / 2 steps, and straight sides whose edges are no longer than theirs.
TEST(TightLinks, AChainOfThreeHasEdgesOfAboutOneLength) {
  for (const std::uint32_t n : {16u, 24u, 100u}) {
    const TightLink link = chain_of_three(n);
    const PolygonShape shape = shape_of(link.centres);
    EXPECT_LE(shape.longest_edge, 2 * pi / (n / 2) + 1e-6) << n;
    EXPECT_GT(shape.shortest_edge, 0.6 * shape.longest_edge) << n;
    EXPECT_NEAR(shape.length, 2 * 4 * pi + 4 * pi + 4, 70.0 / n / n) << n;
  }
}

}  // namespace
}  // namespace catena::bench

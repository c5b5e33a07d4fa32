// Knots whose ropelength was proved or published are within it.
#include "catena/bench/knots/known_knots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/knots/published_knots.h"
#include "catena/bench/knots/test_knots.h"
#include "catena/bench/knots/tight_links.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

using std::numbers::pi;

TEST(KnownKnots, AreWithinAtEveryNumberOfVertices) {
  for (const std::uint32_t n : {16u, 17u, 40u, 128u, 500u})
    for (const KnownKnot& knot : carried_knots(n))
      EXPECT_EQ(judged(knot.published, knot.centres, knot.blur).fault(), "") << knot.input << " of " << n;
}

TEST(KnownKnots, FindMoreNearlyWhatIsProvedTheFinerTheyAre) {
  double before = std::numeric_limits<double>::infinity();
  for (const std::uint32_t n : {32u, 128u, 512u}) {
    const TightLink link = hopf_link(n);
    const KnotVerdict v = judged(published_knot("hopf"), link.centres, link.blur);
    const double off = std::abs(v.ropelength() - 8 * pi);
    EXPECT_LT(off, before / 10);
    EXPECT_LT(v.bounds.most - v.bounds.least, 52.0 / n / n);
    before = off;
  }
}

TEST(PublishedKnots, AreEachThereOnceWithASource) {
  std::set<std::string> names;
  for (const PublishedKnot& knot : published_knots()) {
    EXPECT_TRUE(names.insert(knot.name).second) << knot.name;
    EXPECT_EQ(&published_knot(knot.name), &knot);
    EXPECT_GT(knot.source.size(), 20u) << knot.name;
    EXPECT_NE(knot.ropelength > 0, knot.thickness > 0) << knot.name;
    if (knot.ropelength > 0) {
      EXPECT_GT(knot.ropelength, 25) << knot.name;  // a Hopf link takes 8 pi
    }
  }
  EXPECT_THROW(published_knot("9_47"), InputError);
}

// The trefoil that Ridgerunner's README loads: "328 vertex plCurve ... thickness 0.499985".
TEST(PublishedKnots, RidgerunnersTrefoilIsWithinAndNotWhenSpoiled) {
  const auto file = std::filesystem::path(CATENA_SOURCE_DIR) / "../shared/data/knot/3_1_328.vect";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no real file " << file;
  const Input input = open_input(file.string(), {.centres_only = true});
  const Chain centres = input.animation->frame(0);
  const double blur = std::sqrt(3.0) * input.rounding;
  const PublishedKnot& published = published_knot("3_1_328");
  const KnotVerdict v = judged(published, centres, blur);
  EXPECT_EQ(v.fault(), "");
  EXPECT_EQ(v.contacts, 0u);            // the edges between the vertices touch, and vertices only later
  EXPECT_GE(v.contacts_at_most, 375u);  // more than there are struts
  EXPECT_EQ(true_contacts(centres, v.contact->apart()), 0u);
  EXPECT_GT(true_contacts(centres, v.contact->radius), 0u);
  EXPECT_NEAR(v.shape.length / v.contact->radius, 32.7428, 1e-4);
  EXPECT_NEAR(v.ropelength(), 32.7514, 1e-3);  // its bends are tighter by a little
  EXPECT_EQ(judged(published_knot("3_1"), centres, blur).fault(), "");
  EXPECT_EQ(judged(published_knot("knotted"), centres, blur).fault(), "");

  for (const double share : {0.995, 1.005}) {  // half a percent
    PublishedKnot wrong = published;
    wrong.thickness *= share;
    EXPECT_FALSE(judged(wrong, centres, blur).within()) << share;
  }
  std::vector<Sphere> spheres(centres.spheres().begin(), centres.spheres().end());
  const Pair pair = v.contact->pair;
  spheres[pair.i].x +=
      0.01f * (spheres[pair.j].x - spheres[pair.i].x);  // a hundredth of the way to its contact
  spheres[pair.i].y += 0.01f * (spheres[pair.j].y - spheres[pair.i].y);
  spheres[pair.i].z += 0.01f * (spheres[pair.j].z - spheres[pair.i].z);
  EXPECT_FALSE(judged(published, centres.moved(std::move(spheres)), blur).within());
}

}  // namespace
}  // namespace catena::bench

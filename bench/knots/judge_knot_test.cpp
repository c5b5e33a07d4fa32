// Within what bounds a knot is judged to be what was published, and what is said of one that is not.
#include "catena/bench/knots/judge_knot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/knots/known_knots.h"
#include "catena/bench/knots/test_knots.h"
#include "catena/bench/knots/tight_links.h"
#include "catena/core/error.h"

namespace catena::bench {
namespace {

using std::numbers::pi;

// Vertices of two edges that a strut ends on may lie half of an edge aside of its ends, each.
TEST(JudgeKnot, LooksForStrutsAsFarAsTheirVerticesMayBe) {
  const TightLink link = hopf_link(16);
  const PublishedKnot told{.name = "told", .thickness = 0.9, .struts = 1, .strut_tolerance = 0.18};
  const double edge = shape_of(link.centres).longest_edge, strut = 0.9 * 1.18;
  const auto far = static_cast<float>(std::hypot(strut, edge / std::sqrt(8)));
  const KnotVerdict v = judged(told, link.centres, 0);
  EXPECT_EQ(v.contacts_at_most, contacts_at(*variant(), link.centres, far));
  EXPECT_GT(v.contacts_at_most, contacts_at(*variant(), link.centres, static_cast<float>(strut)));
  EXPECT_GT(v.contacts_at_most, contacts_at(*variant(), link.centres, static_cast<float>(v.bounds.most)));
}

TEST(JudgeKnot, RefusesEdgesThatSayNothing) {
  const TightLink link = hopf_link(3);
  EXPECT_THROW(judged(published_knot("hopf"), link.centres, link.blur), InputError);
}

/// A thickness that no edge is long beside has bounds, too; one that no sphere can have is refused before any
/// are made.
TEST(JudgeKnot, TakesAnyThicknessToAnEnd) {
  const TightLink link = hopf_link(64);
  const auto thick = [&](double thickness) {
    return PublishedKnot{.name = "told", .what = "as told", .thickness = thickness, .source = "the caller"};
  };
  const PolygonShape shape = shape_of(link.centres);
  for (const double thickness : {1e17, 1e200, 1e308}) {
    const KnotBounds bounds = bounds_of(thick(thickness), shape, link.blur);
    EXPECT_GT(bounds.least, 0.9 * thickness);
    EXPECT_GE(bounds.most, thickness);
    EXPECT_THROW(judged(thick(thickness * 1e50), link.centres, link.blur), InputError) << thickness;
  }
  auto of_curve = thick(1e308);
  of_curve.of = PublishedKnot::Of::curve;
  EXPECT_GE(bounds_of(of_curve, shape, link.blur).most, 1e308);
}

/// Each of what a verdict may say, of a knot that is within but for that.
TEST(JudgeKnot, SaysTheOneThingThatIsWrong) {
  KnotVerdict right;
  right.bounds = {.thickness = 1, .least = 0.5, .most = 2, .least_bend = 0.5};
  right.shape.tightest_bend = right.shape.greatest_bend = 3, right.shape.least_bend = 1.5;  // about 3
  right.contact = FirstContact{3, {2, 7}};
  right.published.struts = 8, right.contacts_at_most = 2;
  EXPECT_EQ(right.fault(), "") << "what the bend may be is within, as four struts are for a contact";
  const auto said = [&](const auto& change) {
    KnotVerdict wrong = right;
    change(wrong);
    EXPECT_FALSE(wrong.within());
    return wrong.fault();
  };
  EXPECT_EQ(said([](KnotVerdict& v) { v.contact->radius = 0.25f; }),
            "spheres 2 and 7 touch at a radius of 0.25, below 0.5");
  EXPECT_EQ(said([](KnotVerdict& v) { v.contact.reset(), v.searched_to = 1.25; }),
            "spheres up to a radius of 1.25 do not touch");
  EXPECT_EQ(said([](KnotVerdict& v) { v.shape.greatest_bend = 0.25; }),
            "it bends to a radius of 0.25, below 0.5");
  EXPECT_EQ(said([](KnotVerdict& v) { v.shape.least_bend = 2.5; }),
            "spheres up to a radius of 3 fit in, above 2");
  EXPECT_EQ(said([](KnotVerdict& v) { v.contacts_at_most = 1; }), "1 contacts cannot be those of 8 struts");
}

// Of a regular polygon thickness and ropelength are known, and no two vertices are a contact: its bend
// decides.
TEST(JudgeKnot, TakesABendForTheThicknessWhereNothingTouches) {
  for (const std::uint32_t n : {8u, 30u, 200u}) {
    const PublishedKnot told{.name = "told", .ropelength = 2 * n * std::tan(pi / n)};
    const KnotVerdict v = judged(told, ring(n), 1e-7);
    EXPECT_EQ(v.fault(), "") << n;
    EXPECT_NEAR(v.ropelength(), told.ropelength, 1e-3 * told.ropelength);
    PublishedKnot wrong = told;
    wrong.ropelength *= 0.95;
    EXPECT_NE(judged(wrong, ring(n), 1e-7).fault().find("it bends"), std::string::npos);
    wrong.ropelength = told.ropelength * (1.05 + 20.0 / n / n);
    EXPECT_NE(judged(wrong, ring(n), 1e-7).fault().find("fit in"), std::string::npos);
  }
}

/// That the link is not within once this was done to its vertices, and why.
template <class Change>
void expect_fault(const std::string& because, const Change& change,
                  const std::string& variant_name = "Hybrid") {
  const TightLink link = hopf_link(64);
  std::vector<Sphere> spheres(link.centres.spheres().begin(), link.centres.spheres().end());
  change(spheres);
  const auto v = judge_knot(*variant(variant_name), published_knot("hopf"),
                            link.centres.moved(std::move(spheres)), link.blur);
  EXPECT_FALSE(v.within());
  EXPECT_NE(v.fault().find(because), std::string::npos) << v.fault();
}

TEST(SpoiledKnots, AreNotWithin) {
  expect_fault("touch at a radius of", [](auto& s) {
    for (std::size_t i = 64; i < 128; ++i) s[i].x += 0.01f;  // off the other's centre
  });
  expect_fault("touch at a radius of", [](auto& s) { s[64].x += 0.02f; });
  expect_fault("touch at a radius of", [](auto& s) {
    for (std::size_t i = 0; i < 64; ++i) s[i].x *= 0.99f;
  });
  expect_fault("bends to a radius of", [](auto& s) { s[40].x -= 0.05f; });
}

/// A search that misses the pairs of some spheres.
class Forgetful final : public Variant {
 public:
  explicit Forgetful(std::uint32_t spheres) : spheres_(spheres) {}
  void build(const Chain& chain) override { whole_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    whole_->find(chain, {.want = Request::Want::pairs, .pair_limit = request.pair_limit}, result);
    std::erase_if(result.pairs, [&](const Pair& pair) { return pair.i < spheres_; });
    result.pair_count = result.pairs.size();
  }
  Timings timings() const override { return {}; }

 private:
  std::uint32_t spheres_;
  std::unique_ptr<Variant> whole_ = variant("CPU1");
};

TEST(SpoiledKnots, ASearchThatMissesContactsFindsTooThickATube) {
  const TightLink link = hopf_link(64);
  Forgetful none(0), all_of_one(64);
  EXPECT_TRUE(judge_knot(none, published_knot("hopf"), link.centres, link.blur).within());
  const auto v = judge_knot(all_of_one, published_knot("hopf"), link.centres, link.blur);
  EXPECT_NE(v.fault().find("fit in, above"), std::string::npos) << v.fault();
  const KnownKnot trefoil = carried_knots(64)[2];
  ASSERT_EQ(trefoil.published.name, "3_1");
  Forgetful most(trefoil.centres.size() * 9 / 10);
  EXPECT_FALSE(judge_knot(most, trefoil.published, trefoil.centres, 0).within());
}

}  // namespace
}  // namespace catena::bench

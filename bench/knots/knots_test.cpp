#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <set>

#include "catena/bench/knots/judge_knot.h"
#include "catena/bench/knots/known_knots.h"
#include "catena/bench/knots/tight_links.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/property.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

using properties::Dice;
using properties::Subject;

using std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();

std::unique_ptr<Variant> variant(const std::string& name = "Hybrid") {
  return StrategyRegistry::instance().make(name);
}

KnotVerdict judged(const PublishedKnot& published, const Chain& centres, double blur) {
  return judge_knot(*variant(), published, centres, blur);
}

/// A closed random walk with steps of about 1, drawn together at its ends; sometimes in two strands.
Chain closed_walk(Dice& dice, std::uint32_t n) {
  std::vector<Sphere> spheres(n);
  for (std::uint32_t i = 1; i < n; ++i)
    spheres[i] = {spheres[i - 1].x + dice.symmetric(), spheres[i - 1].y + dice.symmetric(),
                  spheres[i - 1].z + dice.symmetric(), 0};
  const std::uint32_t half = n / 2;
  return dice.one_in(2) ? Chain(std::move(spheres), Strands{{0, half, n}, {1, 1}})
                        : Chain(std::move(spheres), Strands::one_closed(n));
}

/// The regular polygon of n vertices on a circle of radius 1, moved by `way` along x.
Chain ring(std::uint32_t n, float way = 0) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < n; ++k)
    spheres.push_back({static_cast<float>(std::cos(2 * pi * k / n)) + way,
                       static_cast<float>(std::sin(2 * pi * k / n)), 0, 0});
  return Chain(std::move(spheres), Strands::one_closed(n));
}

std::uint64_t true_contacts(const Chain& centres, float radius) {
  return reference::find(tube_of(centres, radius)).pair_count;
}

TEST(FirstContact, IsTheLeastRadiusAtWhichAnyPairCollides) {
  Dice dice(1);
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    const Chain centres = closed_walk(dice, 8 + dice.below(40));
    const auto contact = first_contact(*variant(), centres, 3);
    // Every radius at which something may begin to collide: half of every distance, and the next numbers to
    // it.
    float least = infinity;
    for (std::uint32_t i = 0; i < centres.size(); ++i)
      for (std::uint32_t j = i + 1; j < centres.size(); ++j) {
        const Sphere &a = centres[i], &b = centres[j];
        const auto half =
            static_cast<float>(std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z) / 2);
        for (const float r : {std::nextafter(half, 0.0f), half, std::nextafter(half, infinity)})
          if (r < least && r <= 3 && true_contacts(centres, r) > 0) least = r;
      }
    ASSERT_EQ(contact.has_value(), least < infinity);
    if (!contact) continue;
    ++seen;
    EXPECT_EQ(contact->radius, least);
    EXPECT_EQ(true_contacts(centres, contact->apart()), 0u);
    const auto found = reference::find(tube_of(centres, contact->radius)).pairs;
    EXPECT_NE(std::ranges::find(found, contact->pair), found.end());
  }
  EXPECT_GT(seen, 40);
}

TEST(FirstContact, IsTheSameByEveryExactVariant) {
  Dice dice(2);
  std::vector<Chain> chains{hopf_link(32).centres, chain_of_three(24).centres};
  for (int k = 0; k < 4; ++k) chains.push_back(closed_walk(dice, 20 + dice.below(60)));
  for (const Chain& centres : chains) {
    const auto expected = first_contact(*variant("CPU1"), centres, 3);
    ASSERT_TRUE(expected);
    for (const Subject& subject : Subject::available()) {
      if (!subject.exact()) continue;
      const auto contact = first_contact(*subject.make(), centres, 3);
      ASSERT_TRUE(contact) << subject.info.name;
      EXPECT_EQ(contact->radius, expected->radius) << subject.info.name;
      EXPECT_EQ(contact->pair, expected->pair) << subject.info.name;
    }
  }
}

// A circle's own bend is no contact; two circles side by side meet where they come nearest.
TEST(FirstContact, LeavesOutWhatATubeCanBend) {
  EXPECT_FALSE(first_contact(*variant(), ring(40), 4));
  std::vector<Sphere> two;
  for (const float way : {0.0f, 2.5f}) {
    const Chain one = ring(40, way);
    two.insert(two.end(), one.spheres().begin(), one.spheres().end());
  }
  const auto contact = first_contact(*variant(), Chain(std::move(two), Strands{{0, 40, 80}, {1, 1}}), 4);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->radius, std::nextafter(0.25f, 1.0f));  // sin(pi) is 1.2e-16: a quarter just misses
  EXPECT_EQ(contact->pair, (Pair{0, 60}));
}

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

TEST(KnownKnots, AreWithinAtEveryNumberOfVertices) {
  for (const std::uint32_t n : {16u, 17u, 40u, 128u, 500u})
    for (const KnownKnot& knot : carried_knots(n))
      EXPECT_EQ(judged(knot.published, knot.centres, knot.blur).fault(), "") << knot.input << " of " << n;
}

TEST(KnownKnots, FindMoreNearlyWhatIsProvedTheFinerTheyAre) {
  double before = infinity;
  for (const std::uint32_t n : {32u, 128u, 512u}) {
    const TightLink link = hopf_link(n);
    const KnotVerdict v = judged(published_knot("hopf"), link.centres, link.blur);
    const double off = std::abs(v.ropelength() - 8 * pi);
    EXPECT_LT(off, before / 10);
    EXPECT_LT(v.bounds.most - v.bounds.least, 52.0 / n / n);
    before = off;
  }
}

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

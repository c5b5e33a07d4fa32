#include "catena/reference/enclosure.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <limits>

#include "catena/reference/testing/nasty.h"

namespace catena::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
constexpr double infinity = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least = std::numeric_limits<double>::denorm_min(),
                 greatest = std::numeric_limits<double>::max();

bool by_rationals(const Sphere64& p, const Sphere64& c) {
  const Rational dx = Rational(p.x) - Rational(c.x), dy = Rational(p.y) - Rational(c.y),
                 dz = Rational(p.z) - Rational(c.z), s = Rational(p.radius) - Rational(c.radius);
  return s >= 0 && Rational(dx * dx + dy * dy + dz * dz) <= Rational(s * s);
}

void check(const Sphere64& parent, const Sphere64& child) {
  const bool exact = by_rationals(parent, child);
  RC_TAG(exact ? "encloses" : "does not");
  RC_ASSERT(encloses(parent, child) == exact);
  RC_ASSERT(encloses_by_integers(parent, child) == exact);
  RC_ASSERT((shortfall(parent, child) <= 0) == exact);
}

RC_GTEST_PROP(Enclosure, AgreesWithRationalsOnAnyNumbers, ()) {
  const auto sphere = rc::gen::map(
      rc::gen::tuple(testing::any_double(), testing::any_double(), testing::any_double(),
                     testing::any_double()),
      [](const auto& t) {
        return Sphere64{std::get<0>(t), std::get<1>(t), std::get<2>(t), std::fabs(std::get<3>(t))};
      });
  auto parent = *sphere;
  const auto child = *sphere;
  if (*rc::gen::arbitrary<bool>()) parent.radius = std::max(parent.radius, child.radius);
  check(parent, child);
}

RC_GTEST_PROP(Enclosure, AgreesWithRationalsNearTies, ()) {
  // A Pythagorean offset, so that a radius can fit exactly, then a few ulps more or less, at any scale.
  const int k = *rc::gen::inRange(1, 1000000), exponent = *rc::gen::inRange(-1074, 980);
  const double unit = std::ldexp(1.0, exponent), rc = *rc::gen::inRange(0, 1000) * unit;
  const Sphere64 child{2 * k * unit, 3 * k * unit, 6 * k * unit, rc};
  Sphere64 parent{0, 0, 0, 7 * k * unit + rc};
  const int steps = *rc::gen::inRange(-3, 4);
  for (int s = 0; s < std::abs(steps); ++s)
    parent.radius = std::nextafter(parent.radius, steps > 0 ? infinity : 0.0);
  RC_PRE(std::isfinite(parent.radius));
  RC_ASSERT(encloses(parent, child) == (steps >= 0));
  check(parent, child);
}

/// Also deep within it, where no square is near another.
TEST(Enclosure, ASmallerSphereEnclosesNoGreaterOne) {
  for (int exponent = -1070; exponent <= 1020; exponent += 10) {
    const double unit = std::ldexp(1.0, exponent);
    for (const double part : {0.0, 0.25, 0.75}) {
      const Sphere64 small{part * unit, 0, 0, unit}, great{0, 0, 0, 4 * unit};
      EXPECT_FALSE(encloses(small, great)) << exponent;
      EXPECT_FALSE(encloses_by_integers(small, great)) << exponent;
      EXPECT_GT(shortfall(small, great), 0) << exponent;
      EXPECT_TRUE(encloses(great, small)) << exponent;
    }
  }
}

TEST(Enclosure, NumbersThatAreNotFinite) {
  const Sphere64 unit{0, 0, 0, 1};
  EXPECT_TRUE(encloses({0, 0, 0, infinity}, unit));
  EXPECT_TRUE(encloses({0, 0, 0, infinity}, {5, 0, 0, infinity}));
  EXPECT_FALSE(encloses(unit, {0, 0, 0, infinity}));
  EXPECT_FALSE(encloses(unit, {infinity, 0, 0, 0}));
  EXPECT_FALSE(encloses({infinity, 0, 0, 1}, {infinity, 0, 0, 1}));
  for (const Sphere64 bad :
       {Sphere64{nan, 0, 0, 1}, {0, nan, 0, 1}, {0, 0, nan, 1}, {0, 0, 0, nan}, {0, 0, 0, -1}}) {
    EXPECT_FALSE(encloses(bad, unit));
    EXPECT_FALSE(encloses(unit, bad));
    EXPECT_FALSE(encloses({0, 0, 0, infinity}, bad));
    EXPECT_EQ(shortfall(unit, bad), infinity);
  }
}

TEST(Enclosure, EndsOfTheRange) {
  EXPECT_TRUE(encloses({0, 0, 0, least}, {0, 0, 0, least}));
  EXPECT_TRUE(encloses({0, 0, 0, 3 * least}, {2 * least, 0, 0, least}));
  EXPECT_FALSE(encloses({0, 0, 0, 2 * least}, {2 * least, 0, 0, least}));
  EXPECT_TRUE(encloses({0, 0, 0, greatest}, {greatest, 0, 0, 0}));
  EXPECT_FALSE(encloses({0, 0, 0, greatest}, {greatest, least, 0, 0}));
  EXPECT_FALSE(encloses({-greatest, 0, 0, greatest}, {greatest, 0, 0, 0}));
}

TEST(Enclosure, Shortfall) {
  EXPECT_DOUBLE_EQ(shortfall({0, 0, 0, 2}, {3, 0, 0, 1}), 1);     // out by 2 of 2
  EXPECT_DOUBLE_EQ(shortfall({0, 0, 0, 4}, {1, 0, 0, 1}), -0.5);  // 2 of 4 to spare
  EXPECT_DOUBLE_EQ(shortfall({0, 0, 0, 2}, {0, 0, 0, 3}), 0.5);   // concentric
  EXPECT_DOUBLE_EQ(shortfall({0, 0, 0, 1}, {1, 0x1p-30, 0, 0}), 0x1p-61);
  EXPECT_EQ(shortfall({0, 0, 0, 0}, {1, 0, 0, 0}), infinity);
}

/// Where the squares of three coordinates are lost one by one, and that of the radius is not.
TEST(Enclosure, SquaresThatUnderflowAreLeftToIntegers) {
  const double unit = 0x1p-537, away = 0.63 * unit;  // unit^2 is the least number; 3 * 0.63^2 = 1.19
  const Sphere64 parent{0, 0, 0, unit}, point{away, away, away, 0};
  ASSERT_EQ(away * away, 0);
  ASSERT_GT(unit * unit, 0);
  EXPECT_FALSE(encloses(parent, point));
  EXPECT_FALSE(encloses_by_integers(parent, point));
  EXPECT_TRUE(separate(parent, point));
  EXPECT_TRUE(separate_by_integers(parent, point));
}

/// A leaf is the chain's sphere in each of its numbers.
TEST(Enclosure, ALeafOfAnotherPlaceIsForeign) {
  const Chain chain({{0, 1, 2, 1}, {4, 0, 0, 1}});
  for (const auto& [leaf, foreign] :
       std::initializer_list<std::pair<Sphere64, std::uint64_t>>{{{0, 1, 2, 1}, 0},
                                                                 {{0.5, 1, 2, 1}, 1},
                                                                 {{0, 1.5, 2, 1}, 1},
                                                                 {{0, 1, 2.5, 1}, 1},
                                                                 {{0, 1, 2, 0.5}, 1}}) {
    EnclosureChecker checker(chain);
    checker.tree({.nested = true});
    checker.edge(2, Sphere64{0, 0, 0, 9}, 0, leaf);
    EXPECT_EQ(checker.report().foreign_leaves, foreign);
  }
}

TEST(Enclosure, CheckerReportsViolationsAndForeignLeaves) {
  const Chain chain({{0, 0, 0, 1}, {2, 0, 0, 1}, {4, 0, 0, 1}});
  EnclosureChecker checker(chain);
  checker.tree({.nested = true});
  const Sphere64 a{0, 0, 0, 1}, b{2, 0, 0, 1}, ab{1, 0, 0, 2}, small{2, 0, 0, 2};
  checker.edge(3, ab, 0, a);
  checker.edge(3, ab, 1, b);
  checker.edge(4, small, 3, ab);  // out by 1 of 2
  checker.edge(4, small, 2, Sphere64{4, 0, 0, 0});
  EXPECT_EQ(checker.report().bounds, 4u);
  EXPECT_EQ(checker.report().violations, 1u);
  EXPECT_DOUBLE_EQ(checker.report().worst_shortfall, 0.5);
  EXPECT_DOUBLE_EQ(checker.report().share(), 0.25);
  EXPECT_EQ(checker.report().foreign_leaves, 1u);
  EXPECT_EQ(checker.shape().depth, 3u);
  EXPECT_TRUE(checker.shape().is_tree());
}

TEST(Enclosure, CheckerSaysTheSameWhenAskedAgain) {
  const Chain chain({{0, 0, 0, 1}, {2, 0, 0, 1}});
  EnclosureChecker checker(chain);
  checker.tree({.nested = false});
  for (const std::uint32_t i : {0u, 1u}) checker.edge(2, Sphere64{0, 0, 0, 1}, i, Everything{});
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(checker.report().bounds, 2u);
    EXPECT_EQ(checker.report().violations, 1u);
  }
}

TEST(TreeShape, FindsWhatIsNotATree) {
  const auto shape = [](std::uint32_t leaves, std::vector<std::pair<std::uint32_t, std::uint32_t>> edges) {
    TreeShapeBuilder builder(leaves);
    for (const auto& [parent, child] : edges) builder.add(parent, child);
    return builder.shape();
  };
  EXPECT_TRUE(shape(9, {}).is_tree());  // no hierarchy
  const TreeShape wide = shape(4, {{4000000000u, 0}, {4000000000u, 1}, {4000000000u, 2}, {4000000000u, 3}});
  EXPECT_TRUE(wide.is_tree());
  EXPECT_EQ(wide.nodes, 5u);
  EXPECT_EQ(wide.depth, 2u);
  EXPECT_EQ(shape(3, {{3, 0}, {3, 1}}).lost_leaves, 1u);
  EXPECT_EQ(shape(4, {{4, 0}, {4, 1}, {5, 2}, {5, 3}}).roots, 2u);
  EXPECT_EQ(shape(2, {{2, 0}, {2, 0}, {2, 1}}).shared, 1u);
  EXPECT_EQ(shape(2, {{2, 0}, {2, 1}, {3, 4}, {4, 3}}).lost_inner, 2u);  // a cycle beside the tree
  EXPECT_EQ(shape(2, {{2, 0}, {2, 1}, {2, 3}}).barren, 1u);
  EXPECT_FALSE(shape(2, {{2, 0}, {0, 1}}).is_tree());  // a leaf with a child
}

}  // namespace
}  // namespace catena::reference

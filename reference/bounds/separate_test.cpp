#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "catena/reference/bounds.h"
#include "catena/reference/testing/bodies.h"

namespace catena::reference {
namespace {

using testing::any_scale, testing::infinity;
using testing::Body, testing::Kind, testing::Shown, testing::Whole;

/// Asks in both orders, with and without estimates, as it is and seen in a mirror.
void expect_separate(const Body& a, const Body& b, bool separate_, double scale) {
  for (const bool mirrored : {false, true}) {
    const Shown p(mirrored ? a.mirrored() : a, scale), q(mirrored ? b.mirrored() : b, scale);
    RC_ASSERT(separate(p, q) == separate_);
    RC_ASSERT(separate(q, p) == separate_);
    RC_ASSERT(separate_by_integers(p, q) == separate_);
    RC_ASSERT(separate_by_integers(q, p) == separate_);
  }
}
RC_GTEST_PROP(BoundsSeparate, TouchingIsNotAndOneStepMoreIs, ()) {
  // Extreme points of the two along a direction meet, or are as far apart along it as the sum of the radii.
  const Body a = testing::any_body(testing::any_kind());
  Body b = testing::any_body(testing::any_kind());
  const double scale = any_scale();
  Whole n = testing::any_direction(9);  // in general meets corners
  switch (*rc::gen::inRange(0, 3)) {
    case 0:  // an edge meets an edge, or a face
      if (!a.edges.empty() && !b.edges.empty()) n = cross(a.edges[0], b.edges[0]);
      break;
    case 1:  // a face
      if (!a.edges.empty()) n = a.edges[0];
      break;
    default:
      break;
  }
  if (n == Whole{0, 0, 0}) n = {0, 0, 1};
  if (!is_round(a) && !is_round(b)) {
    b = b.moved(a.furthest(n) - b.furthest(-1 * n));
    expect_separate(a, b, false, scale);
    expect_separate(a, b.moved(n), true, scale);
    return;
  }
  const testing::Frame frame = testing::any_frame();  // a direction whose length is an integer
  n = frame.axes[0];
  const int steps = *rc::gen::inRange(1, 50);
  b = b.moved(a.furthest(n) + steps * n - b.furthest(-1 * n));
  const double reach = static_cast<double>(steps * frame.length);
  const double part = is_round(a) && is_round(b) ? std::floor(reach * *rc::gen::inRange(0, 9) / 8) : 0;
  Body thick = is_round(a) ? a : b, other = is_round(a) ? b : a;
  if (is_round(other)) other.radius = part;
  expect_separate(thick.with_radius(reach - part), other, false, scale);
  if (part == reach) return;
  expect_separate(thick.with_radius(std::nextafter(reach - part, infinity)), other, false, scale);
  expect_separate(thick.with_radius(std::nextafter(reach - part, 0)), other, true, scale);
}

RC_GTEST_PROP(BoundsSeparate, NotWithAPointInBoth, ()) {
  Body a = testing::any_body(testing::any_kind());
  Body b = testing::any_body(testing::any_kind());
  const auto side = [] { return *rc::gen::inRange(-1, 2); };
  b = b.moved(a.some_point({side(), side(), side(), side()}) -
              b.some_point({side(), side(), side(), side()}));
  for (Body* body : {&a, &b})
    if (is_round(*body)) body->radius = *rc::gen::inRange(0, 3);
  expect_separate(a, b, false, any_scale());
}

RC_GTEST_PROP(BoundsSeparate, NoPointOfOneIsInTheOther, ()) {
  // Near enough for both answers: separate bodies share none of their corners and edges' middles.
  Body a = testing::any_body(testing::any_kind()), b = testing::any_body(testing::any_kind());
  b = b.moved(a.centre - b.centre + testing::any_whole(60));
  for (Body* body : {&a, &b})
    if (is_round(*body)) body->radius = *rc::gen::inRange(0, 10);
  const Shown p(a, 1), q(b, 1);
  const bool apart = separate_by_integers(p, q);
  expect_separate(a, b, apart, any_scale());
  RC_TAG(apart ? "separate" : "not");
  for (int corner = 0; corner < 81; ++corner) {
    const Vector64 c =
        a.some_point({corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 % 3 - 1, corner / 27 - 1}).scaled(1);
    RC_ASSERT(!(apart && contains(q, Sphere64{c.x, c.y, c.z, 0})));
  }
}

RC_GTEST_PROP(BoundsSeparate, ParallelAndDegenerateCapsules, ()) {
  const testing::Frame f = testing::any_frame();
  const double scale = any_scale();
  const int along = *rc::gen::inRange(-20, 21), away = *rc::gen::inRange(1, 20);
  const Body a{Kind::capsule, {0, 0, 0}, {5 * f.axes[0]}, 0};
  const Body b{Kind::capsule, along * f.axes[0], {*rc::gen::inRange(-3, 4) * f.axes[0]}, 0};
  const std::int64_t half = std::abs(b.edges[0] * f.axes[0]) / (f.length * f.length);
  if (std::abs(along) <= 5 + half) {  // side by side
    const double reach = static_cast<double>(away * f.length);
    expect_separate(a.with_radius(reach), b.moved(away * f.axes[1]), false, scale);
    expect_separate(a.with_radius(std::nextafter(reach, 0)), b.moved(away * f.axes[1]), true, scale);
  } else {  // in line
    const double reach = static_cast<double>((std::abs(along) - 5 - half) * f.length);
    expect_separate(a.with_radius(reach), b, false, scale);
    expect_separate(a.with_radius(std::nextafter(reach, 0)), b, true, scale);
  }
  // Beside the middle of one, one of the ends of the other.
  const int aside = *rc::gen::inRange(-4, 5);
  for (const int end : {-1, 1}) {
    const Body across{Kind::capsule, aside * f.axes[0] + (away + 3) * f.axes[1], {3 * end * f.axes[1]}, 0};
    const double reach = static_cast<double>(away * f.length);
    expect_separate(a.with_radius(reach), across, false, scale);
    expect_separate(a.with_radius(std::nextafter(reach, 0)), across, true, scale);
  }
  // A capsule without length is a sphere, and a box without size a point.
  const Whole c = testing::any_whole(9);
  const Body ball{Kind::sphere, c, {}, 3}, pill{Kind::capsule, c, {{0, 0, 0}}, 3},
      point{Kind::box, c, {{0, 0, 0}}, 0}, dot{Kind::sphere, c, {}, 0};
  Body other = testing::any_body(testing::any_kind());
  other.centre = c + testing::any_whole(30);
  if (is_round(other)) other.radius = 2;
  const Shown with(other, scale);
  RC_ASSERT(separate(Shown(ball, scale), with) == separate(Shown(pill, scale), with));
  RC_ASSERT(separate(Shown(point, scale), with) == separate(Shown(dot, scale), with));
}

TEST(BoundsSeparate, InfiniteEnds) {
  const Box64 half{{-infinity, -infinity, 1}, {infinity, infinity, infinity}};
  const Slab up{{0, 0, 3}, 3, infinity}, down{{0, 0, 1}, -infinity, 1};
  for (const AnyBound& above : {AnyBound(half), AnyBound(Slabs64{{0, 0, 0}, {&up, 1}})}) {
    for (const double z : {1.0, std::nextafter(1.0, 2), std::nextafter(1.0, 0)}) {
      EXPECT_EQ(separate(above, Sphere64{7, 8, 0, z}), z < 1) << z;
      EXPECT_EQ(separate(above, Capsule64{{7, 8, 0}, {1e300, 0, -1e300}, z}), z < 1) << z;
      EXPECT_EQ(separate(above, Box64{{0, 0, -infinity}, {1, 1, z}}), z < 1) << z;
    }
    EXPECT_FALSE(separate(above, Slabs64{{0, 0, 0}, {&down, 1}}));
    EXPECT_TRUE(separate(above, Slabs64{{0, 0, -0x1p-1074}, {&down, 1}}));
  }
  for (const AnyBound& all : {AnyBound(Everything{}), AnyBound(Sphere64{0, 0, 0, infinity}),
                              AnyBound(Slabs64{}), AnyBound(Capsule64{{0, 0, 0}, {1, 0, 0}, infinity})}) {
    EXPECT_FALSE(separate(all, half));
    EXPECT_FALSE(separate_by_integers(all, half));
    EXPECT_FALSE(separate_by_integers(half, all));
    EXPECT_FALSE(separate_by_integers(all, Sphere64{0, 0, 0, 1}));
    EXPECT_FALSE(separate_by_integers(Sphere64{0, 0, 0, 1}, all));
    EXPECT_FALSE(separate(all, Slabs64{{0, 0, 0}, {&up, 1}}));
    EXPECT_FALSE(separate(all, all));
  }
}

TEST(BoundsSeparate, SlabsThatExcludeEachOther) {
  const std::vector<Slab> none{{{1, 0, 0}, 0, 1}, {{0, 1, 0}, 0, 1}, {{1, 1, 0}, 3, 4}};
  const std::vector<Slab> parallel{{{1, 0, 0}, 0, 1}, {{2, 0, 0}, 3, 4}};
  for (const auto& slabs : {none, parallel}) {
    const Slabs64 empty{{0, 0, 0}, slabs};
    EXPECT_TRUE(separate(empty, Box64{{0, 0, 0}, {1, 1, 1}}));
    EXPECT_TRUE(separate(empty, Sphere64{0, 0, 0, 100}));
    EXPECT_TRUE(separate(empty, Capsule64{{0, 0, 0}, {1, 2, 3}, 100}));
    EXPECT_FALSE(contains(empty, Sphere64{0.5, 0.5, 0, 0}));
  }
}

TEST(BoundsSeparate, NumbersOfBothEndsOfTheRange) {
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  const Capsule64 needle{{-most, 0, 0}, {most, 0, 0}, 0};
  const Slab up{{0, most, 0}, 1, infinity};  // y >= 1 / most, which is no number
  for (const AnyBound& b :
       {AnyBound(Sphere64{0, least, 0, 0}), AnyBound(Capsule64{{0, least, 0}, {most, most, 0}, 0}),
        AnyBound(Box64{{0, least, 0}, {most, most, 0}}), AnyBound(Slabs64{{0, 0, 0}, {&up, 1}})}) {
    EXPECT_TRUE(separate(needle, b));
    EXPECT_TRUE(separate(b, needle));
  }
  EXPECT_FALSE(separate(needle, Sphere64{1e30, least, 0, least}));
  EXPECT_FALSE(separate(needle, Box64{{0, 0, 0}, {least, least, 0}}));
  EXPECT_FALSE(separate(needle, Capsule64{{0, most, 0}, {0, 0, 0}, 0}));
  EXPECT_TRUE(separate(Sphere64{0, most, 0, most}, Capsule64{{1, -least, 0}, {2, 0, 0}, 0}));
  // Squares that underflow to a few steps, and a direction whose square does.
  const double small = 0x1p-537;
  const Box64 below{{-1, -1, -1}, {0, 0, 0}};
  const Slab part{{0x1p-600, 0, 0}, 2 * 0x1p-600, 3 * 0x1p-600};
  EXPECT_FALSE(separate(below, Sphere64{0.75 * small, 0.75 * small, -0.5, 1.2 * small}));
  EXPECT_FALSE(separate(Slabs64{{0, 0, 0}, {&part, 1}}, Sphere64{1.5, 0, 0, 1}));
  EXPECT_FALSE(contains(Slabs64{{0, 0, 0}, {&part, 1}}, Sphere64{2.5, 0, 0, 1}));
}

}  // namespace
}  // namespace catena::reference

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "catena/reference/bounds.h"
#include "catena/reference/testing/bodies.h"
#include "catena/reference/testing/nasty.h"

namespace catena::reference {
namespace {

using testing::Body, testing::Frame, testing::Kind, testing::Shown, testing::Whole;
using Rational = boost::multiprecision::cpp_rational;
using testing::any_scale, testing::infinity;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Sphere64 ball(Whole centre, double radius, double scale) {
  const Vector64 c = centre.scaled(scale);
  return {c.x, c.y, c.z, radius * scale};
}
void expect_contains(const AnyBound& bound, const Sphere64& s, bool in) {
  RC_ASSERT(contains(bound, s) == in);
  RC_ASSERT(contains_by_integers(bound, s) == in);
  RC_ASSERT((shortfall(bound, s) <= 0) == in);
  RC_ASSERT(encloses(bound, s) == in);
}

RC_GTEST_PROP(BoundsContain, BallThatTouchesIsInAndOneStepMoreIsNot, ()) {
  // Of integers: the ball touches a face of the box or slabs, or the capsule's surface from within.
  const Frame f = testing::any_frame();
  const double scale = any_scale();
  const int r = *rc::gen::inRange(1, 30);  // of the ball, in lengths of the frame
  const double radius = static_cast<double>(r * f.length);
  const Whole c = testing::any_whole(1000);
  const auto check = [&](const Body& body) {
    const Shown bound(body, scale);
    expect_contains(bound, ball(c, radius, scale), true);
    expect_contains(bound, ball(c, std::nextafter(radius, 0), scale), true);
    expect_contains(bound, ball(c, std::nextafter(radius, infinity), scale), false);
  };
  const auto more = [] { return *rc::gen::inRange(0, 9); };
  Body slabs{Kind::slabs, c, {(r + more()) * f.axes[0], (r + more()) * f.axes[1], (r + more()) * f.axes[2]}};
  slabs.origin = testing::any_whole(9);
  const int side = *rc::gen::inRange(0, 3);  // moved to touch one side of it
  const std::int64_t room = slabs.edges[side] * f.axes[side] / (f.length * f.length) - r;
  check(slabs.moved((*rc::gen::arbitrary<bool>() ? room : -room) * f.axes[side]));
  const Whole half{r * f.length + more(), r * f.length, r * f.length + more()};
  check(Body{Kind::box, c, {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}}});
  const int away = *rc::gen::inRange(-9, 10), on = *rc::gen::inRange(-4, 5);
  check(Body{Kind::capsule, c + on * f.axes[0] + away * f.axes[1], {5 * f.axes[0]}}.with_radius(
      radius + static_cast<double>(std::abs(away) * f.length)));
  const int past = *rc::gen::inRange(0, 9);
  check(Body{Kind::capsule, c + (5 + past) * f.axes[0], {5 * f.axes[0]}}.with_radius(
      radius + static_cast<double>(past * f.length)));
  check(Body{Kind::sphere, c + past * f.axes[2], {}}.with_radius(radius +
                                                                 static_cast<double>(past * f.length)));
}

using testing::dot;
Rational square(const std::array<Rational, 3>& v) { return dot(v, v); }
std::array<Rational, 3> minus(const Vector64& a, const Vector64& b) {
  return {Rational(a.x) - Rational(b.x), Rational(a.y) - Rational(b.y), Rational(a.z) - Rational(b.z)};
}

/// The definitions, word by word.
bool by_rationals(const Box64& b, const Sphere64& s) {
  const Rational r(s.radius);
  const auto in = [&](double low, double c, double high) {
    return Rational(low) <= Rational(c) - r && Rational(c) + r <= Rational(high);
  };
  return in(b.low.x, s.x, b.high.x) && in(b.low.y, s.y, b.high.y) && in(b.low.z, s.z, b.high.z);
}
bool by_rationals(const Slabs64& b, const Sphere64& s) {
  return std::ranges::all_of(b.slabs, [&](const Slab& slab) {
    const auto d = minus(slab.direction, {0, 0, 0});
    const Rational at = dot(d, minus({s.x, s.y, s.z}, b.origin)), r(s.radius), reach = r * r * square(d);
    const Rational above = Rational(slab.high) - at, below = at - Rational(slab.low);
    return above >= 0 && below >= 0 && above * above >= reach && below * below >= reach;
  });
}
bool by_rationals(const Capsule64& c, const Sphere64& s) {
  const Vector64 p{s.x, s.y, s.z};
  const auto u = minus(c.b, c.a), w = minus(p, c.a);
  Rational t = square(u) == 0 ? Rational(0) : Rational(dot(u, w) / square(u));
  t = t < 0 ? Rational(0) : t > 1 ? Rational(1) : t;
  const Rational room = Rational(c.radius) - Rational(s.radius);
  return room >= 0 && square({w[0] - t * u[0], w[1] - t * u[1], w[2] - t * u[2]}) <= room * room;
}

RC_GTEST_PROP(BoundsContain, AgreesWithRationalsNearTies, ()) {
  // Numbers of no pattern, and bounds that just contain the sphere, or just do not.
  const int exponent = *rc::gen::inRange(-60, 60);
  const auto number = [&] { return std::ldexp(*rc::gen::inRange(-1000000, 1000000) / 997.0, exponent); };
  const auto vector = [&] { return Vector64{number(), number(), number()}; };
  const auto step = [](double v) {  // or one up or down
    const int steps = *rc::gen::inRange(-1, 2);
    return steps == 0 ? v : std::nextafter(v, steps * infinity);
  };
  const Sphere64 s{number(), number(), number(), std::fabs(number())};
  const Box64 box{{step(s.x - s.radius), step(s.y - s.radius), step(s.z - s.radius)},
                  {step(s.x + s.radius), step(s.y + s.radius), step(s.z + s.radius)}};
  RC_TAG(by_rationals(box, s) ? "box contains" : "box does not");
  expect_contains(box, s, by_rationals(box, s));

  Capsule64 capsule{vector(), vector(), 0};
  const auto u = minus(capsule.b, capsule.a), w = minus({s.x, s.y, s.z}, capsule.a);
  const double t =
      square(u) == 0 ? 0 : std::clamp(static_cast<double>(Rational(dot(u, w) / square(u))), 0.0, 1.0);
  const auto d = [&](int k) { return static_cast<double>(w[k]) - t * static_cast<double>(u[k]); };
  capsule.radius = std::fabs(step(std::hypot(d(0), d(1), d(2)) + s.radius));
  RC_TAG(by_rationals(capsule, s) ? "capsule contains" : "capsule does not");
  expect_contains(capsule, s, by_rationals(capsule, s));

  std::vector<Slab> slab{{vector(), 0, infinity}};
  const Slabs64 slabs{vector(), slab};
  const Vector64& n = slab[0].direction;
  RC_PRE(n != (Vector64{0, 0, 0}));
  slab[0].low = step(n.x * (s.x - slabs.origin.x) + n.y * (s.y - slabs.origin.y) +
                     n.z * (s.z - slabs.origin.z) - s.radius * std::hypot(n.x, n.y, n.z));
  slab[0].high = std::numeric_limits<double>::max();
  RC_TAG(by_rationals(slabs, s) ? "slab contains" : "slab does not");
  expect_contains(slabs, s, by_rationals(slabs, s));
}

RC_GTEST_PROP(BoundsContain, AgreesWithRationalsOnAnyNumbers, ()) {
  const auto number = [] { return *testing::any_double(); };
  const auto vector = [&] { return Vector64{number(), number(), number()}; };
  const Sphere64 s{number(), number(), number(), std::fabs(number())};
  const Capsule64 capsule{vector(), vector(), std::fabs(number())};
  expect_contains(capsule, s, by_rationals(capsule, s));
  Box64 box{vector(), vector()};
  for (auto [low, high] :
       {std::pair(&box.low.x, &box.high.x), {&box.low.y, &box.high.y}, {&box.low.z, &box.high.z}})
    if (*low > *high) std::swap(*low, *high);
  expect_contains(box, s, by_rationals(box, s));
  const std::vector<Slab> slab{{vector(), -std::fabs(number()), std::fabs(number())}};
  RC_PRE(slab[0].direction != (Vector64{0, 0, 0}));
  const Slabs64 slabs{vector(), slab};
  expect_contains(slabs, s, by_rationals(slabs, s));
}

TEST(BoundsContain, ProperBoundsOnly) {
  const Sphere64 point{0, 0, 0, 0};
  const Slab zero{{0, 0, 0}, -1, 1}, odd{{nan, 0, 0}, -1, 1}, far{{infinity, 0, 0}, -1, 1},
      closed{{1, 0, 0}, 1, -1}, no_end{{1, 0, 0}, nan, 1}, past{{1, 0, 0}, infinity, infinity},
      before{{1, 0, 0}, -infinity, -infinity}, good{{1, 0, 0}, -1, 1};
  const auto slabs = [](const Slab& s, double x = 0) { return Slabs64{{x, 0, 0}, {&s, 1}}; };
  const Box64 cube{{-1, -1, -1}, {1, 1, 1}};
  std::vector<AnyBound> bad{Sphere64{nan, 0, 0, 1},
                            Sphere64{0, 0, 0, nan},
                            Sphere64{0, 0, 0, -1},
                            Sphere64{0, infinity, 0, 1},
                            Capsule64{{0, nan, 0}, {0, 0, 0}, 1},
                            Capsule64{{0, 0, 0}, {0, 0, nan}, infinity},
                            Capsule64{{0, 0, 0}, {0, 0, 0}, -1},
                            Capsule64{{0, 0, 0}, {infinity, 0, 0}, 1},
                            Capsule64{{0, infinity, 0}, {0, 0, 0}, 1},
                            Capsule64{{0, 0, 0}, {0, 0, 0}, nan},
                            slabs(zero),
                            slabs(odd),
                            slabs(far),
                            slabs(closed),
                            slabs(no_end),
                            slabs(past),
                            slabs(before),
                            slabs(good, nan),
                            slabs(good, infinity)};
  for (const double end : {nan, 2.0, infinity}) {
    Box64 box = cube;
    box.low.y = end;
    bad.push_back(box);
  }
  bad.push_back(Box64{{-1, -infinity, -1}, {1, -infinity, 1}});
  for (const AnyBound& b : bad) {
    EXPECT_FALSE(contains(b, point)) << bad.size();
    EXPECT_FALSE(contains_by_integers(b, point));
    EXPECT_EQ(shortfall(b, point), infinity);
    for (const AnyBound& other : {AnyBound(Everything{}), AnyBound(cube), AnyBound(slabs(good)), b}) {
      EXPECT_FALSE(separate(b, other));
      EXPECT_FALSE(separate(other, b));
      EXPECT_FALSE(encloses(b, other));
      EXPECT_FALSE(encloses(other, b));
    }
    if (const auto* s = std::get_if<Sphere64>(&b)) {
      EXPECT_FALSE(contains(cube, *s));
      EXPECT_FALSE(contains(Everything{}, *s));
    }
  }
  EXPECT_TRUE(contains(slabs(good), point));
}

TEST(BoundsContain, InfiniteEndsAndRadii) {
  const Sphere64 s{1e30, -1e-30, 5, 1e30}, all{0, 0, 0, infinity};
  for (const AnyBound& everything :
       {AnyBound(Everything{}), AnyBound(all), AnyBound(Capsule64{{0, 0, 0}, {1, 0, 0}, infinity}),
        AnyBound(Box64{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}),
        AnyBound(Slabs64{})}) {
    EXPECT_TRUE(contains(everything, s));
    EXPECT_TRUE(contains(everything, all));
    EXPECT_LE(shortfall(everything, s), 0);
  }
  const Box64 half{{-infinity, -infinity, -infinity}, {infinity, infinity, 5 + 1e30}};
  EXPECT_FALSE(contains(half, s));  // 5 + 1e30 is rounded
  EXPECT_TRUE(contains(half, Sphere64{0, 0, 0, 1e30}));
  const Slab up{{0, 0, 1}, 0, infinity};
  for (const AnyBound& part : {AnyBound(half), AnyBound(Slabs64{{0, 0, 0}, {&up, 1}})}) {
    EXPECT_FALSE(contains(part, all));
    EXPECT_FALSE(contains_by_integers(part, all));
    EXPECT_EQ(shortfall(part, all), infinity);
    EXPECT_LE(shortfall(part, Sphere64{0, 0, 1, 1}), 0);
  }
  const double most = std::numeric_limits<double>::max();
  EXPECT_FALSE(contains(Box64{{-most, -most, -most}, {most, most, most}}, Sphere64{most, 0, 0, most}));
  EXPECT_TRUE(contains(Box64{{0, -most, -most}, {infinity, most, most}}, Sphere64{most, 0, 0, most}));
  EXPECT_TRUE(contains(half, Sphere{1, 2, 3, 4}));
}

TEST(BoundsContain, Shortfall) {
  const Slab x{{2, 0, 0}, -4, 4};
  EXPECT_DOUBLE_EQ(shortfall(Slabs64{{1, 0, 0}, {&x, 1}}, Sphere64{3, 5, 5, 1}), 0.5);   // out by 1 of 2
  EXPECT_DOUBLE_EQ(shortfall(Slabs64{{1, 0, 0}, {&x, 1}}, Sphere64{1, 5, 5, 1}), -0.5);  // 1 of 2 to spare
  EXPECT_DOUBLE_EQ(shortfall(Box64{{0, 0, 0}, {4, 8, 2}}, Sphere64{1, 1, 1, 3}), 0.5);   // out by 2 of 4
  EXPECT_DOUBLE_EQ(shortfall(Capsule64{{0, 0, 0}, {8, 0, 0}, 1}, Sphere64{4, 3, 0, 2}), 1);  // out by 4 of 4
  EXPECT_DOUBLE_EQ(shortfall(Capsule64{{0, 0, 0}, {8, 0, 0}, 1}, Sphere64{11, 0, 0, 2}), 1) << "past its end";
  EXPECT_DOUBLE_EQ(shortfall(Box64{{0, 0, 0}, {4, 8, 20}}, Sphere64{3, 4, 10, 3}), 0.2);  // out along x alone
  EXPECT_DOUBLE_EQ(shortfall(Box64{{0, 0, -infinity}, {4, 8, 2}}, Sphere64{1, 1, 1, 3}),
                   0.5);  // 8 wide at most
  EXPECT_DOUBLE_EQ(shortfall(Capsule64{{0, 0, 0}, {0, 0, 0}, 4}, Sphere64{1, 0, 0, 1}), -0.5);
  EXPECT_EQ(shortfall(Box64{{0, 0, 0}, {0, 0, 0}}, Sphere64{1, 0, 0, 1}), infinity);
  EXPECT_EQ(shortfall(Box64{{0, 0, 0}, {0, 0, 0}}, Sphere64{0, 0, 0, 0}), 0);
  EXPECT_EQ(shortfall(Box64{{0, 0, 0}, {4, 8, 2}}, Sphere64{0, 0, 0, infinity}), infinity);
  EXPECT_EQ(shortfall(Sphere64{0, 0, 0, 2}, Sphere64{0, 0, 0, 3}), 0.5);
}

}  // namespace
}  // namespace catena::reference

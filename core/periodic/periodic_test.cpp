#include "catena/core/periodic/periodic.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "catena/core/periodic/overlap.h"
#include "catena/core/periodic/test_search.h"
#include "catena/properties/rational_image.h"

namespace catena {
namespace {

using properties::image_squared;
using properties::nearest_squared;
using properties::Rational;

/// The definition, by rational numbers and every image that may matter: no code of core/.
bool overlaps(const Sphere& a, const Sphere& b, int nx, int ny, int nz, const PeriodicBox& box) {
  // Far apart in any arithmetic: most images, which rational numbers would take minutes for.
  const double x = double{b.x} - a.x + nx * box.length[0] + ny * box.xy + nz * box.xz,
               y = double{b.y} - a.y + ny * box.length[1] + nz * box.yz,
               z = double{b.z} - a.z + nz * box.length[2];
  if (std::sqrt(x * x + y * y + z * z) > 1.5 * (double{a.radius} + b.radius) + 1e-3 * std::abs(x))
    return false;
  const Rational reach = Rational(a.radius) + Rational(b.radius);
  return image_squared(a, b, {nx, ny, nz}, box) <= reach * reach;
}

Pairs by_definition(const Chain& chain, const PeriodicBox& box, int boxes) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j) {
      bool found = false;
      for (int x = -boxes; x <= boxes; ++x)
        for (int y = -boxes; y <= boxes; ++y)
          for (int z = -boxes; z <= boxes; ++z) {
            const bool repeats = (x == 0 || box.length[0] > 0) && (y == 0 || box.length[1] > 0) &&
                                 (z == 0 || box.length[2] > 0);
            if (repeats && !found) found = overlaps(chain[i], chain[j], x, y, z, box);
          }
      if (found && !chain.neighbours(i, j)) pairs.push_back({i, j});
    }
  return pairs;
}

std::vector<std::uint32_t> counts_of(const Pairs& pairs, std::uint32_t n) {
  std::vector<std::uint32_t> count(n, 0);
  for (const Pair& pair : pairs) ++count[pair.i], ++count[pair.j];
  return count;
}

struct InABox {
  Chain chain;
  PeriodicBox box;
};

/// Spheres on and off a lattice that divides the box, some boxes away: ties across faces, edges and corners
/// are as common as centres that no image has in binary32.
InABox any_in_a_box() {
  const float step = *rc::gen::element(1.0f, 0.1f, 1.0f / 3);
  const auto edge = [&] { return *rc::gen::inRange(4, 8); };
  const std::array<int, 3> steps{edge(), edge(), edge()};
  PeriodicBox box{{double(steps[0]) * step, double(steps[1]) * step, double(steps[2]) * step}};
  if (*rc::gen::inRange(0, 4) == 0) box.length[*rc::gen::inRange<std::size_t>(0, 3)] = 0;
  const bool tilted = *rc::gen::arbitrary<bool>();
  if (tilted)
    box.xy = *rc::gen::inRange(-2, 3) * double(step), box.xz = *rc::gen::inRange(-2, 3) * double(step),
    box.yz = *rc::gen::inRange(-2, 3) * double(step);
  const auto widths = box.widths();
  double least = 1e9;
  for (const double width : widths)
    if (width > 0) least = std::min(least, width);
  if (least == 1e9) return {Chain(), PeriodicBox{{1, 1, 1}}};
  const auto greatest = static_cast<float>(least / 4 * (1 - 1e-6));
  const bool exact = !tilted && step == 1.0f;
  std::vector<Sphere> spheres;
  for (auto left = *rc::gen::inRange(2, 20); left > 0; --left) {
    const auto coordinate = [&](std::size_t axis) {
      const float on = step * static_cast<float>(*rc::gen::inRange(0, steps[axis] + 1));
      const float off = *rc::gen::element(0.0f, 0.0f, 0.5f * step, 0.01f, -1e-6f);
      return on + off + static_cast<float>(*rc::gen::inRange(-1, 2)) * static_cast<float>(box.length[axis]);
    };
    const float radius = std::min(exact ? static_cast<float>(least / 4) : greatest,
                                  step * *rc::gen::element(0.0f, 0.25f, 0.5f, 0.7f, 1.0f, 9.0f));
    spheres.push_back({coordinate(0), coordinate(1), coordinate(2), radius});
  }
  const auto n = static_cast<std::uint32_t>(spheres.size());
  Strands strands{{0, *rc::gen::inRange<std::uint32_t>(0, n + 1), n}, {*rc::gen::arbitrary<bool>(), 0}};
  Exclusion exclusion = *rc::gen::arbitrary<bool>() ? Exclusion::index(*rc::gen::inRange<std::uint32_t>(1, 4))
                                                    : Exclusion::arc(1.5);
  if (*rc::gen::arbitrary<bool>()) exclusion.extra_pairs.push_back({0, n - 1});
  return {Chain(std::move(spheres), std::move(strands), std::move(exclusion)), box};
}

RC_GTEST_PROP(Periodic, GivesThePairsOfTheDefinition, ()) {
  const auto [chain, box] = any_in_a_box();
  const Pairs expected = by_definition(chain, box, 5);
  const auto variant = *rc::gen::elementOf(
      std::vector<std::string>{"CPU1", "aCPU2+CPU2", "ChainTree", "Grid", "Hybrid", "GPU1@host"});
  RC_CLASSIFY(!expected.empty(), "pairs");
  const Collisions pairs = found(variant, chain, box);
  RC_ASSERT(pairs.pairs == expected);
  RC_ASSERT(pairs.pair_count == expected.size());
  RC_ASSERT(pairs.count == counts_of(expected, chain.size()));
  RC_ASSERT(pairs.found == !expected.empty());
  Request counts, any;
  counts.want = Request::Want::counts, any.want = Request::Want::any;
  RC_ASSERT(found(variant, chain, box, counts).count == counts_of(expected, chain.size()));
  RC_ASSERT(found(variant, chain, box, any).found == !expected.empty());
}

/// One that has searched other chains in other boxes knows nothing of them.
RC_GTEST_PROP(Periodic, SearchesOneChainAfterAnother, ()) {
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), PeriodicBox{{1, 1, 1}});
  Collisions result;
  for (auto left = *rc::gen::inRange(2, 4); left > 0; --left) {
    const auto [chain, box] = any_in_a_box();
    periodic.set_box(box);
    periodic.prepare({.want = *rc::gen::element(Request::Want::any, Request::Want::pairs)});
    periodic.build(chain);
    if (*rc::gen::arbitrary<bool>()) {
      periodic.find(chain, {.want = Request::Want::any}, result);
      RC_ASSERT(result.found == found("CPU1", chain, box).found);
    }
    periodic.find(chain, {}, result);
    std::ranges::sort(result.pairs);
    const Collisions anew = found("CPU1", chain, box);
    RC_ASSERT(result.pairs == anew.pairs);
    RC_ASSERT(result.count == anew.count);
    RC_ASSERT(result.found == anew.found);
  }
}

RC_GTEST_PROP(Periodic, AnswersAPartOfTheSpheres, ()) {
  const auto [chain, box] = any_in_a_box();
  const Pairs all = by_definition(chain, box, 5);
  Request request;
  request.queries.begin = *rc::gen::inRange<std::uint32_t>(0, chain.size() + 1);
  request.queries.end = *rc::gen::inRange<std::uint32_t>(request.queries.begin, chain.size() + 1);
  const Collisions part = found("CPU1", chain, box, request);
  Pairs expected;
  auto count = counts_of(all, chain.size());
  for (const Pair& pair : all)
    if (request.queries.contains(pair.i)) expected.push_back(pair);
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    if (!request.queries.contains(i)) count[i] = 0;
  RC_ASSERT(part.pairs == expected);
  RC_ASSERT(part.pair_count == expected.size());
  RC_ASSERT(part.count == count);
  RC_ASSERT(part.found == !expected.empty());
  request.want = Request::Want::counts;
  RC_ASSERT(found("CPU1", chain, box, request).count == count);
  request.want = Request::Want::any;
  RC_ASSERT(found("CPU1", chain, box, request).found == !expected.empty());
}

/// Both to the last digit, by 100 of them; so on every machine.
void expect_overlap(const Overlap& got, const Rational& q, const Rational& touch) {
  using Digits = boost::multiprecision::cpp_bin_float_100;
  const Digits depth = Digits(touch) - sqrt(Digits(q)),
               margin = q == touch * touch ? Digits(0)
                                           : Digits(Rational(abs(q - touch * touch) / (touch * touch)));
  RC_ASSERT(got.depth == static_cast<double>(depth));
  RC_ASSERT(got.margin == static_cast<double>(margin));
}

RC_GTEST_PROP(Periodic, TellsDepthAndMarginOfTheNearestImage, ()) {
  const auto [chain, box] = any_in_a_box();
  const Collisions pairs = found("CPU1", chain, box);
  RC_CLASSIFY(!pairs.pairs.empty(), "pairs");
  for (std::size_t k = 0; k < std::min<std::size_t>(pairs.pairs.size(), 3); ++k) {
    const Sphere &a = chain[pairs.pairs[k].i], &b = chain[pairs.pairs[k].j];
    const Rational touch = Rational(a.radius) + Rational(b.radius);
    const Overlap overlap = overlap_of(a, b, &box);
    RC_ASSERT(overlap.depth >= 0);
    if (touch > 0) expect_overlap(overlap, nearest_squared(a, b, box, 4), touch);
  }
}

// Depths of a share of 2^-80 of the distance have all their digits, and their sign.
RC_GTEST_PROP(Overlap, LosesNothingNearATie, ()) {
  const auto number = [] {
    return std::ldexp(static_cast<float>(*rc::gen::inRange(-1000, 1000)), *rc::gen::inRange(-60, 3));
  };
  const Sphere a{number(), 0, 0, std::abs(number())};
  const Sphere b{a.x + a.radius + 1, number(), number(), 1};
  const Rational dx = Rational(b.x) - Rational(a.x),
                 q = dx * dx + Rational(b.y) * Rational(b.y) + Rational(b.z) * Rational(b.z);
  expect_overlap(overlap_of(a, b), q, Rational(a.radius) + 1);
}

// The nearest numbers of binary64: rounded to the 64 digits of x87 before, the last digit is another.
TEST(Overlap, IsRoundedOnce) {
  EXPECT_EQ(overlap_of({0, 0, 0, 100}, {75, 72, 0, 100}).depth, 96.03365929301926);
  EXPECT_EQ(overlap_of({0, 0, 0, 100}, {51, 40, 0, 100}).depth, 135.1848783076048);
}

TEST(Overlap, OfTwoPointsHasAMarginOfZeroOrWithoutEnd) {
  const Sphere point{1, 2, 3, 0};
  EXPECT_EQ(overlap_of(point, {2, 2, 3, 0}).margin, std::numeric_limits<double>::infinity());
  EXPECT_EQ(overlap_of(point, {2, 2, 3, 0}).depth, -1);
  EXPECT_EQ(overlap_of(point, point).margin, 0);
}

TEST(Overlap, SeesATieAcrossAFace) {
  const PeriodicBox box{{10, 10, 10}, 2.5, 0, 0};
  // The image of b along the second edge is at (3.5, 10, 0): 3, 4, 5.
  EXPECT_EQ(overlap_of({0.5, 6, 0, 3}, {1, 0, 0, 2}, &box).depth, 0);
  EXPECT_EQ(overlap_of({0.5, 6, 0, 3}, {1, 0, 0, 2}, &box).margin, 0);
  EXPECT_DOUBLE_EQ(overlap_of({0.5, 6, 0, 3}, {1, 0, 0, 2.5}, &box).depth, 0.5);
  EXPECT_DOUBLE_EQ(overlap_of({0, 0, 0, 1}, {9, 0, 0, 1}).depth, -7);
  EXPECT_THROW(overlap_of({0, 0, 0, 1}, {5, 5, 5, 1}, &box), std::logic_error);
  // 6, 8, 10: half of this box's width, less so little that rounding takes the way for that to the next
  // image.
  const PeriodicBox half{{25, 40, 0}, 30, 0, 0};
  EXPECT_NEAR(overlap_of({0x1p-50f, 0, 0, 5}, {8, -6, 0, 5}, &half).depth, 0.8 * 0x1p-50, 1e-25);
  EXPECT_NEAR(overlap_of({8, -6, 0, 5}, {0x1p-50f, 0, 0, 5}, &half).depth, 0.8 * 0x1p-50, 1e-25);
  EXPECT_EQ(overlap_of({1, 2, 3, 0}, {1, 2, 3, 0}).depth, 0) << "two points at one place";
  EXPECT_EQ(overlap_of({1, 2, 3, 0}, {1, 2, 3, 0}).margin, 0);
}

float nudged(float value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, 1e30f);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -1e30f);
  return value;
}

// A bound that errs by an ulp decides one of these otherwise than the integers do.
RC_GTEST_PROP(PeriodicBox, ImagesOverlapAsByIntegers, ()) {
  const float scale = std::ldexp(1.0f, *rc::gen::inRange(-60, 61));
  const auto number = [&] { return scale * static_cast<float>(*rc::gen::inRange(-1000, 1000)) / 64; };
  PeriodicBox box{{double(std::abs(number())) + scale * 0.1, double(std::abs(number())) + scale / 3,
                   double(std::abs(number())) + scale}};
  if (*rc::gen::arbitrary<bool>()) box.xy = number(), box.xz = number() * 0.1, box.yz = number();
  const Shift shift{*rc::gen::inRange(-3, 4), *rc::gen::inRange(-3, 4), *rc::gen::inRange(-3, 4)};
  const Sphere a{number(), number(), number(), std::abs(number())};
  // b at about the distance of touching, along one axis of the image.
  const auto moved = box.along({double(shift[0]), double(shift[1]), double(shift[2])});
  const float radius = std::abs(number());
  Sphere b{static_cast<float>(a.x - moved[0] + a.radius + radius), static_cast<float>(a.y - moved[1]),
           static_cast<float>(a.z - moved[2]), radius};
  for (int ulps = -3; ulps <= 3; ++ulps) {
    Sphere near = b;
    near.x = nudged(b.x, ulps);
    RC_ASSERT(image_overlaps(a, near, shift, box) == image_overlaps_by_integers(a, near, shift, box));
    RC_ASSERT(image_overlaps_by_integers(a, near, shift, box) ==
              overlaps(a, near, shift[0], shift[1], shift[2], box));
  }
}

// Reaches far below the box, so that the rounding of the image's place is all the doubt there is: the length
// is made for the image to touch, and is then some last places off. The tilt keeps that rounding from undoing
// itself.
RC_GTEST_PROP(PeriodicBox, ImagesFarAwayOverlapAsByIntegers, ()) {
  for (int time = 0; time < 20; ++time) {
    const auto number = [] {
      return std::ldexp(static_cast<float>(*rc::gen::inRange(1 << 20, 1 << 24)), -20);
    };
    const std::int32_t steps = *rc::gen::element(1, 3, 5, 7), back = *rc::gen::element(1, 3, 5, 7);
    const Sphere a{number(), 0, 0, std::ldexp(number(), -*rc::gen::inRange(4, 60))},
        b{-number(), static_cast<float>(back), 0, std::ldexp(number(), -*rc::gen::inRange(4, 60))};
    const double tilt = double{number()} / 7;
    double length = (double{a.radius} + b.radius + a.x - b.x + back * tilt) / steps;
    for (int k = 0; k < 2; ++k) length = std::nextafter(length, 0);
    for (int k = 0; k < 5; ++k, length = std::nextafter(length, 1e300)) {
      const PeriodicBox box{{length, 1, 1}, tilt};
      const Shift there{steps, -back, 0}, here{-steps, back, 0};
      RC_ASSERT(image_overlaps(a, b, there, box) == image_overlaps_by_integers(a, b, there, box));
      RC_ASSERT(image_overlaps(b, a, here, box) == image_overlaps_by_integers(b, a, here, box));
    }
  }
}

// By the definition: the volume over the area of the face, for edges that are all there.
RC_GTEST_PROP(PeriodicBox, IsAsWideAsItsFacesAreApart, ()) {
  const auto length = [] { return *rc::gen::inRange(1, 100) / 8.0; };
  const auto tilt = [] { return *rc::gen::inRange(-100, 100) / 16.0; };
  const PeriodicBox box{{length(), length(), length()}, tilt(), tilt(), tilt()};
  const std::array<std::array<double, 3>, 3> edge{
      {{box.length[0], 0, 0}, {box.xy, box.length[1], 0}, {box.xz, box.yz, box.length[2]}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &u = edge[(k + 1) % 3], &v = edge[(k + 2) % 3];
    const double area =
        std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    const double expected = box.length[0] * box.length[1] * box.length[2] / area;
    RC_ASSERT(std::abs(box.widths()[k] - expected) <= 1e-12 * expected);
  }
}

// Of edges that are not all there, too: the others may lean toward one that does not repeat.
RC_GTEST_PROP(PeriodicBox, HasNoImageNearerThanItsWidths, ()) {
  const auto tilt = [] { return *rc::gen::inRange(-100, 100) / 16.0; };
  PeriodicBox box{{0, 0, 0}, tilt(), tilt(), tilt()};
  for (double& length : box.length)
    if (*rc::gen::inRange(0, 3) > 0) length = *rc::gen::inRange(1, 100) / 8.0;
  const auto most = [&](std::size_t k) { return box.length[k] > 0 ? 3 : 0; };
  for (int a = -most(0); a <= most(0); ++a)
    for (int b = -most(1); b <= most(1); ++b)
      for (int c = -most(2); c <= most(2); ++c) {
        const std::array<double, 3> shift{double(a), double(b), double(c)};
        const auto [x, y, z] = box.along(shift);
        for (std::size_t k = 0; k < 3; ++k)
          RC_ASSERT(std::hypot(x, y, z) >= box.widths()[k] * std::abs(shift[k]) * (1 - 1e-12));
      }
}

// 0.1f + 10 is no number in binary32: the images of these two touch, and do not, as only exact arithmetic
// tells.
TEST(Periodic, DecidesATieAcrossAFaceThatNoImageHasInBinary32) {
  const float x = 0.1f, other = 9.5f;
  const auto gap = static_cast<float>(double{x} + 10 - other);
  const double exact = double{x} + 10 - other;
  ASSERT_NE(static_cast<double>(gap), exact);
  const float above = gap > exact ? gap : std::nextafter(gap, 1.0f), below = std::nextafter(above, 0.0f);
  for (const auto& [reach, expected] : {std::pair(above, 1u), std::pair(below, 0u)}) {
    const Chain chain({{x, 0, 0, reach}, {5, 5, 5, 0}, {other, 0, 0, 0}});
    EXPECT_EQ(found("aCPU2+CPU2", chain, {{10, 10, 10}}).pair_count, expected);
  }
}

/// A sphere just below one face, and one just within reach of it across the next image of that face, which a
/// tilt brings nearer than the edge is long.
TEST(Periodic, FindsWhatTouchesAcrossATiltedFace) {
  for (const double tilt : {-6., 0., 6.})
    for (const float radius : {0.5f, 1.0f, 1.75f}) {
      const PeriodicBox box{{20, 8, 0}, tilt};
      const double width = box.widths()[0], reach = 2 * radius;
      // The face's normal: from the upper face of the box's image to what lies beyond it.
      const auto x = static_cast<float>(reach * width / 20 * (1 - 1e-6)),
                 y = static_cast<float>(-tilt / 8 * x);
      const Sphere below{19.999f, 0, 0, radius}, beyond{x - 0.001f, y, 0, radius};
      const Chain chain({below, {10, 4, 0, 0}, beyond, {0, 0, 99, 0}, {0, 4, 99, 0}});
      const Pairs expected = by_definition(chain, box, 3);
      EXPECT_EQ(expected, (Pairs{{0, 2}})) << tilt << ' ' << radius;
      EXPECT_EQ(found("CPU1", chain, box).pairs, expected) << tilt << ' ' << radius;
    }
}

/// Ties of numbers that binary32 has, in boxes whose thirds, sevenths and so on it has not: what looks for
/// images divides by the width, and must look as far as the tie.
TEST(Periodic, FindsEveryTieAcrossAFaceInBoxesOfAnyWidth) {
  for (int width = 3; width <= 60; ++width)
    for (int sixteenths = 1; sixteenths <= 4 * width; sixteenths += 1 + width / 8)
      for (const float shift : {0.0f, 0.375f, -7.0f}) {
        const float radius = static_cast<float>(sixteenths) / 16,
                    other = static_cast<float>(width) - 2 * radius;
        const PeriodicBox box{{static_cast<double>(width), 0, 0}};
        const Chain touching({{shift, 0, 0, radius}, {shift, 999, 0, 0}, {shift + other, 0, 0, radius}});
        const bool both = other <= 2 * radius;  // through the middle, too
        EXPECT_EQ(found("CPU1", touching, box).pairs, (Pairs{{0, 2}}))
            << width << ' ' << radius << ' ' << shift;
        const Chain apart(
            {{shift, 0, 0, std::nextafter(radius, 0.0f)}, {shift, 999, 0, 0}, {shift + other, 0, 0, radius}});
        if (!both) {
          EXPECT_EQ(found("CPU1", apart, box).pair_count, 0u) << width << ' ' << radius << ' ' << shift;
        }
      }
}

}  // namespace
}  // namespace catena

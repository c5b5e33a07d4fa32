#include "catena/core/frames/frame_difference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace catena {
namespace {

std::vector<Sphere> row(std::uint32_t n) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i)
    spheres.push_back({static_cast<float>(i), static_cast<float>(i * i % 97), 0, 1});
  return spheres;
}

bool in(const std::vector<SphereRange>& ranges, std::uint32_t i) {
  for (const SphereRange& range : ranges)
    if (range.contains(i)) return true;
  return false;
}

TEST(FrameDifference, EverySphereThatDiffersIsInARange) {
  const std::uint32_t n = 203;
  const std::vector<Sphere> before = row(n);
  std::vector<SphereRange> ranges;
  ranges.reserve(64);
  EXPECT_TRUE(differing(before, before, n, ranges));
  EXPECT_TRUE(ranges.empty());
  for (std::uint32_t i = 0; i < n; ++i)
    for (float Sphere::*field : {&Sphere::x, &Sphere::y, &Sphere::z, &Sphere::radius}) {
      std::vector<Sphere> now = before;
      now[i].*field = std::nextafter(now[i].*field, 1e30f);
      ASSERT_TRUE(differing(before, now, n, ranges));
      EXPECT_TRUE(in(ranges, i)) << i;
      ASSERT_EQ(ranges.size(), 1u);
      EXPECT_LE(ranges[0].end, n);
    }
  std::vector<Sphere> now = before;
  now[5].z = -0.0f;  // equal, but not the same bits
  EXPECT_TRUE(differing(before, now, n, ranges));
  EXPECT_TRUE(in(ranges, 5));
}

/// In steps of 16, those side by side as one, the last one cut at the end.
TEST(FrameDifference, RangesThatMeetAreOne) {
  const std::vector<Sphere> before = row(203);
  std::vector<Sphere> now = before;
  std::vector<SphereRange> ranges;
  ranges.reserve(2);
  for (const std::uint32_t i : {17u, 40u, 50u, 202u}) now[i].x += 1;
  ASSERT_TRUE(differing(before, now, 59, ranges));
  EXPECT_EQ(ranges, (std::vector<SphereRange>{{16, 64}, {192, 203}}));
  EXPECT_FALSE(differing(before, now, 58, ranges)) << "48 and 11";
}

/// Of 61 spheres spread from the first to the last.
TEST(FrameDifference, TheShareIsOfSpheresFromEndToEnd) {
  const std::vector<Sphere> before = row(61);
  for (const std::uint32_t i : {0u, 30u, 60u}) {
    std::vector<Sphere> now = before;
    now[i].x += 1;
    EXPECT_DOUBLE_EQ(share_that_differs(before, now), 1 / 61.0) << i;
  }
}

TEST(FrameDifference, StopsWhereThereIsTooMuchOfIt) {
  const std::vector<Sphere> before = row(1000);
  std::vector<Sphere> now = before;
  for (std::uint32_t i = 0; i < 1000; i += 40) now[i].x += 1;
  std::vector<SphereRange> few;
  few.reserve(4);
  EXPECT_FALSE(differing(before, now, 1000, few));
  std::vector<SphereRange> many;
  many.reserve(64);
  EXPECT_FALSE(differing(before, now, 100, many));
  EXPECT_TRUE(differing(before, now, 1000, many));
  EXPECT_EQ(many.size(), 25u);
  EXPECT_DOUBLE_EQ(share_that_differs(before, before), 0);
  for (Sphere& s : now) s.y += 1;
  EXPECT_DOUBLE_EQ(share_that_differs(before, now), 1);
}

TEST(FrameDifference, AShiftIsFoundInBothDirectionsAndOnlyWhereEverySphereAgrees) {
  const std::vector<Sphere> longer = row(400);
  const std::vector<Sphere> before(longer.begin() + 100, longer.begin() + 300);
  for (const int s : {1, 7, 8, 60, -1, -8, -60}) {
    const std::vector<Sphere> now(longer.begin() + 100 + s, longer.begin() + 300 + s);
    EXPECT_EQ(shift_between(before, now, 100, 0), s);
    EXPECT_EQ(shift_between(before, now, std::abs(s), 0), s) << "no farther than that";
    EXPECT_EQ(shift_between(before, now, 0, s), s) << "guessed";
    EXPECT_FALSE(shift_between(before, now, std::abs(s) - 1, 0)) << "farther than looked for";
    for (std::uint32_t i = 0; i < now.size(); ++i) {
      std::vector<Sphere> spoilt = now;
      spoilt[i].radius = std::nextafter(spoilt[i].radius, 0.0f);
      const auto come_in =
          s > 0 ? i >= now.size() - static_cast<std::uint32_t>(s) : i < static_cast<std::uint32_t>(-s);
      EXPECT_EQ(shift_between(before, spoilt, 100, 0).has_value(), come_in) << s << ' ' << i;
      EXPECT_EQ(shift_between(before, spoilt, 100, s).has_value(), come_in) << s << ' ' << i;
    }
  }
  EXPECT_FALSE(shift_between(before, before, 100, 0)) << "no shift is none";
  const std::vector<Sphere> other(longer.begin(), longer.begin() + 200);
  for (const int s : {200, -200, 300}) EXPECT_FALSE(shift_between(before, other, 0, s)) << "nothing stays";
}

/// A chain that repeats itself looks shifted in many places, each of which would be compared as a whole.
TEST(FrameDifference, LooksAtFewPlacesWhereAShiftMayBe) {
  constexpr std::size_t period = 20;
  for (const int s : {1, 3, 4, 5, 9}) {
    std::vector<Sphere> before = row(400);
    for (std::size_t i = period; i < before.size(); ++i) before[i] = before[i - period];
    std::vector<Sphere> now = before;
    // Only at the right one does the last sphere agree, too.
    before.back().y += 1;
    now[before.size() - 1 - static_cast<std::size_t>(s) * period].y += 1;
    const auto by = static_cast<std::int64_t>(s * period);
    EXPECT_EQ(shift_between(before, now, 300, 0), s <= 4 ? std::optional(by) : std::nullopt) << s;
    EXPECT_EQ(shift_between(before, now, 300, by), by) << s << ", guessed";
  }
}

}  // namespace
}  // namespace catena

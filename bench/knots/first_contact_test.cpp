// The least radius at which a tube touches itself, against all pairs.
#include "catena/bench/knots/first_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "catena/bench/knots/test_knots.h"
#include "catena/bench/knots/tight_links.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/property.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

using properties::Dice;
using properties::Subject;

constexpr float infinity = std::numeric_limits<float>::infinity();

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

}  // namespace
}  // namespace catena::bench

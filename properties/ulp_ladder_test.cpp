#include "catena/properties/testing/ulp_ladder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/arithmetic/robust.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/property.h"
#include "catena/reference/exact_gap.h"

/// Exactly touching pairs, moved by -4 to +4 ulp in every coordinate and radius: which arithmetic decides
/// wrongly, where.
namespace catena::properties {
namespace {

/// Wrong decisions by step, for coordinates and for radii.
struct Rungs {
  std::array<std::array<std::uint32_t, 9>, 2> wrong{}, asked{};
  void count(int step, bool radius, bool is_wrong) {
    wrong[radius][static_cast<std::size_t>(step + 4)] += is_wrong;
    ++asked[radius][static_cast<std::size_t>(step + 4)];
  }
  std::uint32_t total() const {
    std::uint32_t sum = 0;
    for (const auto& row : wrong)
      for (const std::uint32_t w : row) sum += w;
    return sum;
  }
};

template <class Arithmetic>
Rungs ladder() {
  Rungs rungs;
  climb_ulps([&](int step, bool radius, const Sphere& a, const Sphere& b) {
    const bool overlap = Arithmetic::overlap(Arithmetic::bound(a), Arithmetic::bound(b));
    rungs.count(step, radius, overlap != reference::overlap(a, b));
  });
  return rungs;
}

void print(const char* name, const Rungs& rungs) {
  for (const bool radius : {false, true}) {
    std::cout << fmt::format("{:<8} {:<11}", name, radius ? "radius" : "coordinate");
    for (std::size_t s = 0; s < 9; ++s)
      std::cout << fmt::format("{:>7.2f}", 100.0 * rungs.wrong[radius][s] / rungs.asked[radius][s]);
    std::cout << '\n';
  }
}

TEST(UlpLadder, RobustNeverFlipsTheRoundedOnesDo) {
  std::cout << "wrong decisions, percent, by ulp moved\n" << fmt::format("{:<20}", "");
  for (int step = -4; step <= 4; ++step) std::cout << fmt::format("{:>+7}", step);
  std::cout << '\n';
  const Rungs literal = ladder<Literal>(), wide = ladder<Double>(), robust = ladder<Robust>();
  print("literal", literal), print("double", wide), print("robust", robust);
  EXPECT_EQ(robust.total(), 0u);
  EXPECT_GT(literal.total(), 0u) << "the ladder is too easy";
}

TEST(UlpLadder, NoExactVariantFlips) {
  std::vector<std::unique_ptr<Variant>> variants;
  for (const Subject& subject : Subject::available())
    if (subject.exact() && !subject.info.on_device()) variants.push_back(subject.make());
  std::uint64_t asked = 0;
  climb_ulps([&](int, bool, const Sphere& a, const Sphere& b) {
    const Chain chain({a, b}, {{0, 1, 2}, {}});  // two strands, so that the two are no neighbours
    const bool expected = reference::overlap(a, b);
    Request request;
    request.want = Request::Want::counts;
    Collisions found;
    for (const auto& variant : variants) {
      variant->build(chain);
      variant->find(chain, request, found);
      ++asked;
      if (found.found != expected)
        ADD_FAILURE() << fmt::format("({}, {}, {}, {}) and ({}, {}, {}, {})", a.x, a.y, a.z, a.radius, b.x,
                                     b.y, b.z, b.radius);
    }
  });
  EXPECT_GT(asked, 500'000u);
}

/// Sums of radii that agree with a distance to its last digits, which binary64 rounds away: one sphere
/// against many alike, so that vectors of pairs are full, too.
TEST(UlpLadder, NoExactVariantFlipsWhereBinary64Does) {
  std::vector<std::unique_ptr<Variant>> variants;
  for (const Subject& subject : Subject::available())
    if (subject.exact() && !subject.info.on_device()) variants.push_back(subject.make());
  int flips = 0;
  Dice dice(1);
  for (int k = 0; k < 4000; ++k) {
    // Of few digits every other time, so that it is the radii alone whose sum is rounded.
    const auto number = [&] {
      return k % 2 ? dice.symmetric() : static_cast<float>(dice.between(-999, 999)) / 1024;
    };
    Sphere a{number(), number(), number(), 0},
        b{0x1p-9f * number(), 0x1p-9f * number(), 0x1p-9f * number(), 0};
    const double distance = std::hypot(double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z);
    a.radius = std::nextafter(static_cast<float>(distance), 0.0f);
    b.radius = static_cast<float>(distance - a.radius);
    const bool expected = reference::overlap(a, b);
    if (Double::overlap(Double::bound(a), Double::bound(b)) == expected) continue;
    ++flips;
    std::vector<Sphere> spheres(20, b);
    spheres.push_back(a);
    const Chain chain(std::move(spheres), {{0, 20, 21}, {}}, Exclusion::index(20));
    Collisions found;
    for (const auto& variant : variants) {
      variant->build(chain);
      variant->find(chain, {}, found);
      EXPECT_EQ(found.pair_count, expected ? 20u : 0u) << k;
    }
  }
  EXPECT_GT(flips, 10);
}

}  // namespace
}  // namespace catena::properties

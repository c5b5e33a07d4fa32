#include "catena/core/chain/chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>

#include "catena/core/error.h"

namespace catena {
namespace {

std::vector<Sphere> row(std::uint32_t n, float spacing = 1, float radius = 1) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({spacing * static_cast<float>(i), 0, 0, radius});
  return spheres;
}

void expect_refused(std::vector<Sphere> spheres, Strands strands, Exclusion exclusion,
                    const std::string& words) {
  try {
    Chain chain(std::move(spheres), std::move(strands), std::move(exclusion));
    ADD_FAILURE() << "accepted; expected an error with '" << words << "'";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(Chain, NamesTheSphereThatIsNotValid) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const Sphere& bad : {Sphere{nan, 0, 0, 1}, Sphere{0, inf, 0, 1}, Sphere{0, 0, -inf, 1},
                            Sphere{0, 0, 0, nan}, Sphere{0, 0, 0, inf}}) {
    auto spheres = row(5);
    spheres[3] = bad;
    expect_refused(spheres, {}, {}, "sphere 3 is not finite");
  }
  auto spheres = row(5);
  spheres[2].radius = -1;
  expect_refused(spheres, {}, {}, "sphere 2 has the negative radius -1");
}

TEST(Chain, ChecksASphereWhereverItIs) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::uint32_t n = 1; n <= 9; ++n)
    for (std::uint32_t i = 0; i < n; ++i) {
      auto spheres = row(n);
      spheres[i].y = nan;
      expect_refused(spheres, {}, {}, "sphere " + std::to_string(i) + " is not finite");
      spheres[i] = {0, 70, 0, 9};
      const Extent extent = Chain(spheres).view().extent;
      EXPECT_EQ(extent.greatest_coordinate, 70) << n << ' ' << i;
      EXPECT_EQ(extent.greatest_radius, 9) << n << ' ' << i;
    }
}

TEST(Chain, RefusesImpossibleStrandsAndRules) {
  expect_refused(row(5), {{0, 3, 4}, {}}, {}, "offsets must run from 0 to 5");
  expect_refused(row(5), {{1, 5}, {}}, {}, "offsets must run from 0 to 5");
  expect_refused(row(5), {{0, 4, 2, 5}, {}}, {}, "strand 1 ends before it starts");
  for (const std::vector<std::uint8_t>& closed : {{1}, {0, 1, 0}, std::vector<std::uint8_t>(6, 1)})
    expect_refused(row(5), {{0, 2, 5}, closed}, {}, "2 strands need 2 closed flags");
  expect_refused(row(5), {}, Exclusion::index(0), "window must be at least 1");
  for (double f :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    expect_refused(row(5), {}, Exclusion::arc(f), "arc window must be");
  auto rule = Exclusion::index(1);
  rule.extra_pairs = {{1, 5}};
  expect_refused(row(5), {}, rule, "extra pair (1, 5)");
  rule.extra_pairs = {{2, 2}};
  expect_refused(row(5), {}, rule, "extra pair (2, 2)");
}

TEST(Chain, IndexWindowOnAnOpenStrand) {
  const Chain chain(row(10), {}, Exclusion::index(2));
  for (std::uint32_t i = 0; i < 10; ++i)
    for (std::uint32_t j = 0; j < 10; ++j)
      if (i != j) {
        EXPECT_EQ(chain.neighbours(i, j), std::abs(int(i) - int(j)) <= 2) << i << ' ' << j;
      }
}

TEST(Chain, IndexWindowIsCyclicOnAClosedStrandAndStaysOnItsStrand) {
  const Chain chain(row(12), {{0, 7, 12}, {1, 0}}, Exclusion::index(2));
  EXPECT_TRUE(chain.neighbours(0, 6) && chain.neighbours(6, 0) && chain.neighbours(1, 6) &&
              chain.neighbours(0, 5));
  EXPECT_FALSE(chain.neighbours(1, 5));
  EXPECT_FALSE(chain.neighbours(6, 7)) << "the next strand is no neighbour";
  EXPECT_TRUE(chain.neighbours(7, 9));
  EXPECT_FALSE(chain.neighbours(7, 11)) << "the second strand is open";
}

TEST(Chain, ArcWindowIsStrictAndUsesBothRadii) {
  auto spheres = row(10);
  spheres[4].radius = 2;
  const Chain chain(spheres, {}, Exclusion::arc(1.5));  // radii 1 + 1: nearer than 3
  EXPECT_TRUE(chain.neighbours(0, 2));
  EXPECT_FALSE(chain.neighbours(0, 3)) << "exactly 3 is not nearer than 3";
  EXPECT_TRUE(chain.neighbours(0, 4)) << "radii 1 + 2: nearer than 4.5";
  EXPECT_FALSE(chain.neighbours(4, 9));
}

TEST(Chain, ArcWindowGoesRoundAClosedStrand) {
  std::vector<Sphere> ring;
  for (int i = 0; i < 12; ++i) {
    const double a = 2 * std::numbers::pi * i / 12;
    ring.push_back({float(10 * std::cos(a)), float(10 * std::sin(a)), 0, 1});
  }
  const Chain chain(ring, Strands::one_closed(12), Exclusion::arc(3));  // step 5.18, window 6
  EXPECT_TRUE(chain.neighbours(0, 11) && chain.neighbours(11, 0));
  EXPECT_FALSE(chain.neighbours(0, 10));
}

/// Steps of whole lengths, so that arcs are exact and many pairs lie at the very limit, ahead or around the
/// end; by the definition, on the shortest way along the strand.
/// Lengths are of a strand, wherever the one before it ends.
TEST(Chain, ArcsBeginAnewWithEachStrand) {
  std::vector<Sphere> ring;
  for (int i = 0; i < 12; ++i)
    ring.push_back({static_cast<float>(std::cos(i * std::numbers::pi / 6)),
                    static_cast<float>(std::sin(i * std::numbers::pi / 6)), 0, 0.3f});
  std::vector<Sphere> both(1, Sphere{500, 0, 0, 0.3f});
  both.insert(both.end(), ring.begin(), ring.end());
  const Chain alone(ring, Strands::one_closed(12), Exclusion::arc(2)),
      second(both, {{0, 1, 13}, {0, 1}}, Exclusion::arc(2));
  EXPECT_EQ(second.view().exclusion.loop_length[1], alone.view().exclusion.loop_length[0]);
  for (std::uint32_t i = 0; i < 12; ++i) {
    EXPECT_EQ(second.view().exclusion.arc[i + 1], alone.view().exclusion.arc[i]);
    for (std::uint32_t j = 0; j < 12; ++j) EXPECT_EQ(second.neighbours(i + 1, j + 1), alone.neighbours(i, j));
  }
}

TEST(Chain, WindowsEndAtTheirLimitAheadAndAroundTheEnd) {
  std::uint64_t at_the_limit = 0, around = 0;
  for (std::uint32_t n = 1; n <= 9; ++n)
    for (std::uint32_t seed = 0; seed < 40; ++seed)
      for (const bool closed : {false, true}) {
        std::vector<Sphere> spheres;
        std::vector<float> arc;  // along x, to and fro
        for (std::uint32_t i = 0; i < n; ++i) {
          const float step = i == 0 ? 0 : static_cast<float>((seed * 7 + i * i * 5 + i) % 4);
          const float x = i == 0 ? 0 : spheres[i - 1].x + (2 * i <= n ? step : -step);
          arc.push_back(i == 0 ? 0 : arc[i - 1] + step);
          spheres.push_back({x, 0, 0, static_cast<float>((seed + i) % 3)});
        }
        const float loop = arc.back() + std::abs(spheres.back().x);
        const Strands strands = closed ? Strands::one_closed(n) : Strands{};
        const std::uint32_t window = 1 + seed % 5;
        const Chain by_steps(spheres, strands, Exclusion::index(window)),
            by_arc(spheres, strands, Exclusion::arc(1));
        for (std::uint32_t i = 0; i < n; ++i)
          for (std::uint32_t j = 0; j < n; ++j) {
            if (i == j) continue;
            const std::uint32_t steps = i < j ? j - i : i - j;
            EXPECT_EQ(by_steps.neighbours(i, j), std::min(steps, closed ? n - steps : n) <= window)
                << n << ' ' << seed;
            const float ahead = std::abs(arc[j] - arc[i]),
                        way = closed ? std::min(ahead, loop - ahead) : ahead,
                        limit = spheres[i].radius + spheres[j].radius;
            EXPECT_EQ(by_arc.neighbours(i, j), way < limit) << n << ' ' << seed << ' ' << i << ' ' << j;
            at_the_limit += way == limit, around += way == limit && way < ahead;
          }
      }
  EXPECT_GT(at_the_limit, 500u);
  EXPECT_GT(around, 50u);
}

/// What searches scale themselves by.
TEST(Chain, KnowsItsExtentAlongEveryAxis) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      std::vector<Sphere> spheres{{1, 2, 3, 0.5f}, {2, 1, 1, 4}, {0, 3, 2, 0.25f}};
      (&spheres[1].x)[axis] = sign * 50;
      const Extent extent = Chain(spheres).view().extent;
      double sides = 0;
      for (const auto member : {&Sphere::x, &Sphere::y, &Sphere::z}) {
        const auto [low, high] =
            std::ranges::minmax({spheres[0].*member, spheres[1].*member, spheres[2].*member});
        sides += double{high} - low;
      }
      EXPECT_EQ(extent.sides, sides) << axis;
      EXPECT_EQ(extent.greatest_coordinate, 50);
      EXPECT_EQ(extent.least_radius, 0.25f);
      EXPECT_EQ(extent.greatest_radius, 4);
    }
}

TEST(Chain, TakesArcLengthsThatAreFiniteAndOnesOfEachSphereAndStrand) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto made = [](std::vector<double> arc, std::vector<double> loops) {
    return Chain(row(3), Strands::one_closed(3), Exclusion::arc(1), {std::move(arc), std::move(loops)});
  };
  EXPECT_TRUE(made({0, 5, 9}, {10}).neighbours(0, 2)) << "1 around the end";
  EXPECT_FALSE(made({0, 5, 9}, {10}).neighbours(0, 1));
  for (const double bad : {inf, -inf, nan}) {
    EXPECT_THROW(made({0, bad, 9}, {10}), InputError);
    EXPECT_THROW(made({0, 5, 9}, {bad}), InputError);
  }
  EXPECT_THROW(made({0, 5}, {10}), InputError);
  EXPECT_THROW(made({0, 5, 4}, {10}), InputError) << "they ascend";
  EXPECT_THROW(made({0, 5, 9}, {}), InputError);
}

TEST(Chain, ExtraPairsHoldBothWaysAndOnce) {
  auto rule = Exclusion::index(1);
  rule.extra_pairs = {{8, 2}, {2, 8}, {0, 9}};
  const Chain chain(row(10), {{0, 5, 10}, {}}, rule);
  EXPECT_TRUE(chain.neighbours(2, 8) && chain.neighbours(8, 2) && chain.neighbours(0, 9) &&
              chain.neighbours(9, 0));
  EXPECT_FALSE(chain.neighbours(2, 9));
  EXPECT_EQ(chain.exclusion().extra_pairs, (std::vector<Pair>{{0, 9}, {2, 8}}));
  const Chain one(row(10), {}, rule);
  EXPECT_TRUE(one.neighbours(2, 8) && one.neighbours(8, 2));
  EXPECT_FALSE(one.view().exclusion.window_alone) << "searches ask for no pairs where the window is all";
  EXPECT_TRUE(Chain(row(10)).view().exclusion.window_alone);
}

TEST(Chain, MovedKeepsNeighboursAndChecksItsSpheres) {
  const Chain chain(row(6), {}, Exclusion::arc(1.1));
  const Chain moved = chain.moved(row(6, 50));
  EXPECT_TRUE(moved.neighbours(0, 2)) << "arc lengths are those of the chain as it was made";
  EXPECT_THROW(chain.moved(row(5)), InputError);
  EXPECT_THROW(chain.moved(row(7)), InputError);
  auto bad = row(6);
  bad[1].radius = -1;
  EXPECT_THROW(chain.moved(bad), InputError);
}

TEST(Chain, EmptyAndSingle) {
  EXPECT_EQ(Chain().size(), 0u);
  EXPECT_EQ(Chain().strand_count(), 1u);
  EXPECT_TRUE(Chain().view().topology != 0 && Chain().strands().closed.size() == 1);
  EXPECT_EQ(Chain(row(1)).size(), 1u);
}

/// Of some pairs among all, each from both ends.
TEST(Chain, FindsEveryExtraPairAndNoOther) {
  constexpr std::uint32_t n = 60;
  const auto extra = [](std::uint32_t i, std::uint32_t j) {
    return (i * 7 + j * 11) % 5 == 0 || i == 9 || j == 40;
  };
  Exclusion exclusion = Exclusion::index(1);
  for (std::uint32_t j = n; j-- > 0;)
    for (std::uint32_t i = 0; i < j; ++i)
      if (extra(i, j)) exclusion.extra_pairs.push_back(i % 2 == 0 ? Pair{i, j} : Pair{j, i});
  const Chain chain(row(n, 9), {}, exclusion);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < j; ++i) {
      EXPECT_EQ(chain.neighbours(i, j), j - i <= 1 || extra(i, j)) << i << ' ' << j;
      EXPECT_EQ(chain.neighbours(j, i), chain.neighbours(i, j)) << i << ' ' << j;
    }
}

/// Looked through one by one, the partners of this hub would take 10^10 comparisons.
TEST(Chain, LooksUpAnExtraPairOfManyQuickly) {
  constexpr std::uint32_t n = 200'000;
  Exclusion exclusion = Exclusion::index(1);
  for (std::uint32_t i = 2; i < n; i += 2) exclusion.extra_pairs.push_back({0, i});
  const Chain chain(row(n), {}, exclusion);
  const std::clock_t begin = std::clock();
  std::uint32_t found = 0;
  for (std::uint32_t i = 1; i < n; ++i) found += chain.neighbours(0, i);
  EXPECT_LT(std::clock() - begin, CLOCKS_PER_SEC);
  EXPECT_EQ(found, n / 2);
}

}  // namespace
}  // namespace catena

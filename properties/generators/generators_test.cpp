#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>
#include <sstream>
#include <utility>

#include "catena/core/error.h"
#include "catena/properties/generators/census.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/testing/rapidcheck_chains.h"

namespace catena::properties {
namespace {

std::string text_of(const Chain& chain) {
  std::ostringstream text;
  write_chain(text, chain);
  return text.str();
}

TEST(Generators, EveryFamilyGivesChainsOfEverySizeAsked) {
  for (const Family& family : FamilyRegistry::instance().families())
    for (std::uint32_t size : {1u, 2u, 3u, 64u, 2400u})
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Dice dice(seed);
        const Chain chain = generate(family, dice, size);
        EXPECT_GE(chain.size(), 1u) << family.name;
        EXPECT_LE(chain.size(), size) << family.name;
      }
}

TEST(Generators, AnyFloatHasEitherSignAndEveryExponent) {
  Dice dice(3);
  std::set<std::pair<bool, int>> met;
  for (int k = 0; k < 2000; ++k) {
    const float value = any_float(dice, -3, 3);
    met.emplace(value < 0, std::ilogb(value));
  }
  EXPECT_EQ(met.size(), 2u * 7);
  EXPECT_EQ(met.begin()->second, -3);
  EXPECT_EQ(met.rbegin()->second, 3);
}

TEST(Generators, TheSameDiceGiveTheSameChain) {
  for (const Family& family : FamilyRegistry::instance().families()) {
    Dice first(7), second(7);
    EXPECT_EQ(text_of(generate(family, first, 40)), text_of(generate(family, second, 40))) << family.name;
  }
}

TEST(Generators, AnUnknownFamilyIsSaid) {
  try {
    FamilyRegistry::instance().family("spaghetti");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("walk"), std::string::npos) << error.what();
  }
}

/// The distribution of what the variants' test and fuzzing draw.
TEST(Generators, EveryClassIsHitOftenEnough) {
  Census census;
  std::uint64_t seed = 0;
  for (const Family& family : FamilyRegistry::instance().families())
    for (int round = 0; round < 100; ++round) {
      Dice dice(++seed);
      census.add(family.name,
                 Case::of(generate(family, dice, family.name == "sizes" && round % 4 == 0 ? 2400 : 64)));
    }
  std::cout << census.report();
  for (const auto& missed : census.missed()) ADD_FAILURE() << missed;
}

TEST(Generators, AQuotaThatIsMissedIsSaid) {
  Census census;
  census.add("walk", Case::of(Chain(std::vector<Sphere>(3, Sphere{0, 0, 0, 1}))));
  EXPECT_GT(census.missed().size(), 20u);
}

TEST(Shrinking, EndsAtTheSimplestChainThatStillFails) {
  // "Three spheres or more, one of them with x beyond 1000."
  const auto fails = [](const Chain& chain) {
    return chain.size() >= 3 &&
           std::ranges::any_of(chain.spheres(), [](const Sphere& s) { return s.x > 1000; });
  };
  Dice dice(3);
  for (int round = 0; round < 20; ++round) {
    Draft draft = FamilyRegistry::instance().family("rules").draw(dice, 60);
    while (draft.size() < 5) draft.spheres.push_back({1, 2, 3, 4});
    draft.strands = {};
    draft.spheres[3].x = 123456.789f;
    const Chain simple = shrink(draft.chain(), fails);
    EXPECT_EQ(simple.size(), 3u);
    EXPECT_EQ(simple.exclusion().window, 1u);
    EXPECT_TRUE(simple.exclusion().extra_pairs.empty());
    float sum = 0;
    for (const Sphere& s : simple.spheres()) sum += s.x + std::fabs(s.y) + std::fabs(s.z) + s.radius;
    EXPECT_EQ(sum, 1024) << text_of(simple);
  }
}

TEST(Shrinking, EveryStepIsAChainAndItEnds) {
  for (const Family& family : FamilyRegistry::instance().families()) {
    Dice dice(11);
    const Chain end = shrink(generate(family, dice, 30), [](const Chain& chain) { return chain.size() > 0; });
    EXPECT_EQ(end.size(), 1u) << family.name;
    EXPECT_EQ(end[0], (Sphere{0, 0, 0, 0})) << family.name;
  }
}

TEST(Shrinking, TakesAZeroWithoutASignAndAnOpenStrandForTheSimplerOnes) {
  EXPECT_TRUE(simpler(Chain({{0, 0, 0, 1}}), Chain({{-0.0f, 0, 0, 1}})));
  EXPECT_FALSE(simpler(Chain({{-0.0f, 0, 0, 1}}), Chain({{0, 0, 0, 1}})));
  const std::vector<Sphere> three(3);
  EXPECT_TRUE(simpler(Chain(three), Chain(three, Strands::one_closed(3))));
  EXPECT_FALSE(simpler(Chain(three, Strands::one_closed(3)), Chain(three)));
}

TEST(Shrinking, MovesAChainToTheOriginAndScalesItToOne) {
  Simplifications candidates(Chain({{5, 6, 7, 1}, {9, 8, 8, 1}}));
  std::vector<std::vector<Sphere>> seen;
  while (const auto chain = candidates.next())
    seen.emplace_back(chain->spheres().begin(), chain->spheres().end());
  using Spheres = std::vector<Sphere>;
  for (const Spheres& wanted : {Spheres{{0, 0, 0, 1}, {4, 2, 1, 1}},
                                Spheres{{0.625f, 0.75f, 0.875f, 0.125f}, {1.125f, 1, 1, 0.125f}}})
    EXPECT_EQ(std::ranges::count(seen, wanted), 1);
}

TEST(Shrinking, LeavesTheExtraPairThatMattersWithinItsTries) {
  const Chain chain(std::vector<Sphere>(8, Sphere{1, 2, 3, 1}), {},
                    {Exclusion::Rule::index_window, 1, 0, {{0, 3}, {2, 5}, {4, 7}}});
  std::uint32_t asked = 0;
  const auto fails = [&](const Chain& c) {
    ++asked;
    return c.size() == 8 && std::ranges::count(c.exclusion().extra_pairs, Pair{2, 5}) == 1;
  };
  EXPECT_EQ(shrink(chain, fails).exclusion().extra_pairs, (std::vector<Pair>{{2, 5}}));
  asked = 0;
  shrink(chain, fails, 9);
  EXPECT_EQ(asked, 9u);
}

/// Of three that a failure does not need, and of the same number in several places, there is one step.
TEST(Shrinking, TriesAllExtraPairsAndAllEqualNumbersAtOnce) {
  const Chain chain({{8, 3, 5, 1}, {8, 8, 7, 1}, {9, 9, 9, 1}, {7, 7, 7, 1}}, {},
                    {Exclusion::Rule::index_window, 1, 0, {{0, 2}, {0, 3}, {1, 3}}});
  Simplifications candidates(chain);
  bool no_pairs = false, both_eights = false;
  while (const auto c = candidates.next()) {
    if (c->size() != 4) continue;
    const auto& s = c->spheres();
    no_pairs |= c->exclusion().extra_pairs.empty() && std::ranges::equal(s, chain.spheres());
    both_eights |= s[0] == Sphere{0, 3, 5, 1} && s[1] == Sphere{0, 0, 7, 1};
  }
  EXPECT_TRUE(no_pairs);
  EXPECT_TRUE(both_eights);
}

/// Among them one that a sphere is taken out of, which leaves two strands.
TEST(Shrinking, CutsAStrandWhereASphereWas) {
  Simplifications candidates(Chain(std::vector<Sphere>(5, Sphere{1, 2, 3, 1})));
  std::vector<std::vector<std::uint32_t>> strands;
  while (const auto chain = candidates.next())
    if (chain->strand_count() > 1) strands.push_back(chain->strands().first);
  EXPECT_EQ(strands, (std::vector<std::vector<std::uint32_t>>{{0, 1, 4}, {0, 2, 4}, {0, 3, 4}}));
}

TEST(RapidCheck, ShrinksToAChain) {
  std::ostringstream ignored;
  const auto result = rc::detail::checkTestable([](const Chain& chain) { RC_ASSERT(chain.size() < 4); });
  rc::detail::FailureResult failure;
  ASSERT_TRUE(result.match(failure));
  ASSERT_FALSE(failure.counterExample.empty());
  const std::string& shown = failure.counterExample[0].second;
  EXPECT_NE(shown.find("strand open 4\n0 0 0 0\n0 0 0 0\n0 0 0 0\n0 0 0 0\nend"), std::string::npos) << shown;
}

}  // namespace
}  // namespace catena::properties

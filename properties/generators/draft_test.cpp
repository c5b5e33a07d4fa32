#include "catena/properties/generators/draft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "catena/properties/generators/census.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/rules.h"

/// Edits of a chain in the making against the same on a list of who is in which strand; and what a census
/// tells of a chain, of chains made to be just that or just not.
namespace catena::properties {
namespace {

/// A sphere by its own x, and the number of its strand.
struct Member {
  float x;
  std::size_t strand;
  friend bool operator==(const Member&, const Member&) = default;
};

std::vector<Member> members(const Draft& draft) {
  std::vector<Member> found;
  const Chain chain = draft.chain();
  for (std::size_t s = 0, strand = 0; s < chain.strand_count(); ++s) {
    for (std::uint32_t i = chain.strands().first[s]; i < chain.strands().first[s + 1]; ++i)
      found.push_back({chain[i].x, strand});
    strand +=
        chain.strands().first[s] < chain.strands().first[s + 1];  // those without spheres are not counted
  }
  return found;
}

/// By the x of its spheres.
using Joint = std::pair<float, float>;
std::vector<Joint> joints(const Draft& draft) {
  std::vector<Joint> found;
  for (const Pair& p : draft.exclusion.extra_pairs)
    found.emplace_back(draft.spheres[p.i].x, draft.spheres[p.j].x);
  return found;
}

/// Which strands that have spheres are closed, by the x of the first.
std::vector<float> closed(const Draft& draft) {
  std::vector<float> found;
  const auto& [first, flags] = draft.strands;
  for (std::size_t s = 0; s < flags.size(); ++s)
    if (flags[s] != 0 && first[s] < first[s + 1]) found.push_back(draft.spheres[first[s]].x);
  return found;
}

Draft drawn(Dice& dice, std::uint32_t n) {
  Draft draft;
  for (std::uint32_t i = 0; i < n; ++i) draft.spheres.push_back({static_cast<float>(i), 0, 0, 1});
  if (!dice.one_in(4)) cut_into_strands(draft, dice);
  add_joints(draft, dice);
  return draft;
}

TEST(Draft, RemovesSpheresWithTheirJointsAndStrandsThatAreLeftEmpty) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Dice dice(seed);
    const std::uint32_t n = 2 + dice.below(12);
    const Draft before = drawn(dice, n);
    const std::uint32_t first = dice.below(n), count = 1 + dice.below(n - first);
    Draft draft = before;
    draft.remove(first, count);
    const auto gone = [&](float x) {
      return x >= static_cast<float>(first) && x < static_cast<float>(first + count);
    };
    auto expected = members(before);
    std::erase_if(expected, [&](const Member& m) { return gone(m.x); });
    std::size_t strand = 0;  // renumbered
    for (std::size_t k = 0, last = 0; k < expected.size(); ++k) {
      const std::size_t was = expected[k].strand;
      if (k > 0 && was != last) ++strand;
      last = was, expected[k].strand = strand;
    }
    EXPECT_EQ(members(draft), expected) << seed;
    auto pairs = joints(before);
    std::erase_if(pairs, [&](const Joint& j) { return gone(j.first) || gone(j.second); });
    EXPECT_EQ(joints(draft), pairs) << seed;
    for (std::size_t s = 0; s + 1 < draft.strands.first.size(); ++s)
      EXPECT_LT(draft.strands.first[s], draft.strands.first[s + 1]) << seed;
    // A strand that lost its beginning is closed still.
    EXPECT_EQ(
        std::ranges::count_if(closed(draft), [&](float x) { return !std::ranges::count(closed(before), x); }),
        std::ranges::count_if(closed(before),
                              [&](float x) {
                                const auto of = members(before);
                                const auto strand_of = std::ranges::find(of, x, &Member::x)->strand;
                                return gone(x) && std::ranges::any_of(of, [&](const Member& m) {
                                         return m.strand == strand_of && !gone(m.x);
                                       });
                              }))
        << seed;
  }
}

TEST(Draft, CutsAStrandInTwoOpenOnes) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Dice dice(seed);
    const std::uint32_t n = 2 + dice.below(12), at = dice.below(n);
    const Draft before = drawn(dice, n);
    Draft draft = before;
    draft.cut(at);
    auto expected = members(before);
    const bool begins = at == 0 || expected[at - 1].strand != expected[at].strand;
    if (!begins)
      for (std::uint32_t i = at; i < n; ++i) ++expected[i].strand;
    EXPECT_EQ(members(draft), expected) << seed;
    EXPECT_EQ(joints(draft), joints(before));
    auto rings = closed(before);
    if (!begins)
      std::erase_if(rings, [&](float x) {
        return members(before)[static_cast<std::size_t>(x)].strand == members(before)[at].strand;
      });
    EXPECT_EQ(closed(draft), rings) << seed;
    EXPECT_TRUE(draft.strands.first.empty() || draft.strands.closed.size() + 1 == draft.strands.first.size());
  }
}

TEST(Draft, RepeatsASphereInItsStrand) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Dice dice(seed);
    const std::uint32_t n = 2 + dice.below(12), at = dice.below(n);
    const Draft before = drawn(dice, n);
    Draft draft = before;
    draft.repeat(at);
    auto expected = members(before);
    expected.insert(expected.begin() + at, expected[at]);
    EXPECT_EQ(members(draft), expected) << seed;
    EXPECT_EQ(joints(draft), joints(before)) << seed;
    for (const Pair& p : draft.exclusion.extra_pairs)
      EXPECT_TRUE(p.i != at + 1 && p.j != at + 1) << "of the first of the two";
  }
}

TEST(Rules, KeepTheJointsThatAreThere) {
  for (const auto change : {widen_the_window, measure_by_arc}) {
    Dice dice(3);
    Draft draft = drawn(dice, 9);
    const auto before = joints(draft);
    ASSERT_FALSE(before.empty());
    for (int k = 0; k < 50; ++k) change(draft, dice);
    EXPECT_EQ(joints(draft), before);
    EXPECT_TRUE(draft.exclusion.rule == Exclusion::Rule::arc_window || draft.exclusion.window > 1);
  }
}

TEST(Rules, AWindowIsAboveOneHoweverFewSpheresThereAre) {
  for (std::uint32_t n = 1; n <= 12; ++n)
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      Dice dice(seed);
      Draft draft = drawn(dice, n);
      widen_the_window(draft, dice);
      EXPECT_GT(draft.exclusion.window, 1u) << n;
    }
}

/// How the census marks one chain: names of its traits.
std::vector<std::string> told(const Chain& chain) {
  Census census;
  census.add("walk", Case::of(chain));
  std::vector<std::string> found;
  for (std::size_t t = 0; t < static_cast<std::size_t>(Trait::count); ++t)
    if (census.of(static_cast<Trait>(t)) > 0) found.emplace_back(name_of(static_cast<Trait>(t)));
  return found;
}

TEST(Census, TellsEachTraitOfAChainThatHasItAndOfNoneThatHasNot) {
  const auto row = [](std::uint32_t n, float step, float radius) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({1 + step * static_cast<float>(i), 1, 1, radius});
    return spheres;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(told(Chain(row(1, 1, 1))), Names{});
  EXPECT_EQ(told(Chain(row(2, 9, 1))), (Names{"free of collisions"}));
  EXPECT_EQ(told(Chain(row(7, 1.5f, 1.75f))), (Names{"colliding", "n near a power of two"}));
  EXPECT_EQ(told(Chain(row(10, 1, 1))), (Names{"colliding", "touching exactly", "within 2^-20 of touching"}));
  EXPECT_EQ(told(Chain(row(10, 1, 1.5f))),
            (Names{"colliding", "more pairs than spheres", "touching exactly", "within 2^-20 of touching"}));
  EXPECT_EQ(told(Chain(row(10, 0.5f, 0.5000001f))), (Names{"colliding", "within 2^-20 of touching"}));
  EXPECT_EQ(told(Chain({{1, 1, 1, 0}, {9, 1, 1, 1}})), (Names{"free of collisions", "zero radius"}));
  EXPECT_EQ(told(Chain({{0, 0, 0, 1}, {9, 0, 0, 1}})), (Names{"free of collisions"}))
      << "0 is no denormal number";
  EXPECT_EQ(
      told(Chain({{1, 1, 1, 1}, {9, 1, 1, 1}, {1, 1, 1, 0.5f}, {40, 1, 1, 1}, {60, 1, 1, 1}, {80, 1, 1, 1}})),
      (Names{"colliding", "coincident centres"}));
  const std::vector<Sphere> apart = row(6, 9, 1);
  EXPECT_EQ(told(Chain(apart, {{0, 3, 6}, {0, 0}}))[1], "several strands");
  EXPECT_EQ(told(Chain(apart, Strands::one_closed(6)))[1], "closed strand");
  EXPECT_EQ(told(Chain(apart, {}, Exclusion::index(2)))[1], "window above 1");
  EXPECT_EQ(told(Chain(apart, {}, Exclusion::arc(1.5)))[1], "arc window");
  for (const std::uint32_t n : {3u, 4u, 5u, 15u, 16u, 17u})
    EXPECT_EQ(told(Chain(row(n, 9, 1))).back(), "n near a power of two") << n;
  for (const std::uint32_t n : {6u, 10u, 13u, 18u, 30u, 382u, 386u})
    EXPECT_EQ(told(Chain(row(n, 9, 1))), (Names{"free of collisions"})) << n;
  for (const std::uint32_t n : {383u, 384u, 385u, 767u, 769u, 1535u, 1537u})
    EXPECT_EQ(told(Chain(row(n, 9, 1))).back(), "n near 384, 768 or 1536") << n;
}

/// A quota is missed below its share, and by nobody at all whatever the share; so is a family that is not
/// drawn.
TEST(Census, SaysWhatWasMissed) {
  const Case closed = Case::of(Chain(std::vector<Sphere>(3, Sphere{0, 0, 0, 1}), Strands::one_closed(3)));
  const Case open = Case::of(Chain(std::vector<Sphere>(3, Sphere{0, 0, 0, 1})));
  Census census;
  const auto missed = [&](const std::string& what) {
    const auto all = census.missed();
    return std::ranges::any_of(
        all, [&](const std::string& line) { return line.find("'" + what + "'") != std::string::npos; });
  };
  census.add("walk", closed);
  for (int k = 0; k < 19; ++k) census.add("walk", open);
  EXPECT_FALSE(missed("closed strand")) << "one in 20";
  census.add("walk", open);
  EXPECT_TRUE(missed("closed strand")) << "one in 21";
  EXPECT_TRUE(missed("n near 384, 768 or 1536")) << "no share is asked, but one there must be";
  EXPECT_TRUE(missed("coil"));
  EXPECT_FALSE(missed("walk"));
}

}  // namespace
}  // namespace catena::properties

#include "catena/reference/compare.h"

#include <gtest/gtest.h>

#include "catena/reference/exact_gap.h"
#include "catena/reference/reference.h"

namespace catena::reference {
namespace {

/// 100 spheres a unit apart with radius 1: (i, i + 2) touch, (i, i + 1) are neighbours.
class Compare : public ::testing::Test {
 protected:
  static Chain rod() {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 100; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 1});
    return Chain(spheres);
  }
  Comparison compare_now() const { return compare(chain, exact, found); }

  const Chain chain = rod();
  const Answer exact = find(chain);
  Collisions found{true, exact.pair_count, exact.count, exact.pairs};
};

TEST_F(Compare, RightAnswerInAnyOrder) {
  ASSERT_EQ(exact.pair_count, 98u);
  std::swap(found.pairs.front(), found.pairs.back());
  EXPECT_TRUE(compare_now().right());
  EXPECT_TRUE(compare_now().well_formed());
}

TEST_F(Compare, MissingPair) {
  found.pairs.erase(found.pairs.begin() + 10);
  const Comparison c = compare_now();
  EXPECT_EQ(c.missing, 1u);
  EXPECT_EQ(c.invented, 0u);
  EXPECT_EQ(c.worst_margin, 0);  // the pair touches
  EXPECT_EQ(c.inconsistent_counts, 2u);
  EXPECT_EQ(c.wrong_counts, 0u);
  EXPECT_TRUE(c.wrong_total);
  ASSERT_EQ(c.examples.size(), 1u);
  EXPECT_EQ(c.examples[0].pair, (Pair{10, 12}));
  EXPECT_TRUE(c.examples[0].missing);
  EXPECT_FALSE(c.right());
}

TEST_F(Compare, InventedPair) {
  found.pairs.push_back({0, 3});
  ++found.pair_count, ++found.count[0], ++found.count[3];
  const Comparison c = compare_now();
  EXPECT_EQ(c.invented, 1u);
  EXPECT_EQ(c.worst_margin, 1.25);  // (9 - 4) / 4
  EXPECT_EQ(c.wrong_counts, 2u);
  EXPECT_EQ(c.inconsistent_counts, 0u);
  EXPECT_FALSE(c.right());
  EXPECT_TRUE(c.well_formed());
}

TEST_F(Compare, NeighboursRepeatedAndMalformedPairs) {
  for (const Pair p : {Pair{4, 5}, Pair{0, 2}, Pair{9, 7}, Pair{3, 3}, Pair{0, 100}})
    found.pairs.push_back(p);
  const Comparison c = compare_now();
  EXPECT_EQ(c.invented, 1u);
  EXPECT_EQ(c.neighbours, 1u);
  EXPECT_EQ(c.repeated, 1u);
  EXPECT_EQ(c.malformed, 3u);
  EXPECT_EQ(c.worst_margin, 0);  // no geometry was decided wrongly
  EXPECT_FALSE(c.right());
  EXPECT_FALSE(c.well_formed());
}

TEST_F(Compare, WrongCountsAndTotals) {
  ++found.count[50];
  EXPECT_EQ(compare_now().wrong_counts, 1u);
  EXPECT_EQ(compare_now().inconsistent_counts, 1u);
  --found.count[50];
  EXPECT_TRUE(compare_now().right());
  found.found = false;
  EXPECT_FALSE(compare_now().right());
  found.found = true;
  found.count.pop_back();
  EXPECT_FALSE(compare_now().right());
}

/// The worst margin is that of all wrong pairs, beyond those that are kept as examples, however little it is.
TEST(CompareMany, TellsTheGreatestMarginOfAllWrongPairs) {
  for (const float aside : {0.0f, 0x1p-149f, 0x1p-30f, 0.25f}) {
    std::vector<Sphere> spheres;  // pairs that touch exactly, and a last one that is by `aside` from it
    for (int k = 0; k < 40; ++k)
      for (const float x : {0.0f, 2.0f}) spheres.push_back({x, 9.0f * static_cast<float>(k), 0, 1});
    for (const float x : {0.0f, 2.0f})
      spheres.push_back({x, x == 0 ? -9 : -9 + aside, x == 0 ? 0 : aside, 1});
    const auto n = static_cast<std::uint32_t>(spheres.size());
    Strands alone;
    for (std::uint32_t i = 0; i <= n; ++i) alone.first.push_back(i);
    const Chain chain(std::move(spheres), std::move(alone));
    const Answer exact = find(chain);
    Collisions all{true, 0, std::vector<std::uint32_t>(n, 1), {}};
    for (std::uint32_t i = 0; i < n; i += 2) all.pairs.push_back({i, i + 1});
    all.pair_count = all.pairs.size();
    Collisions none{false, 0, std::vector<std::uint32_t>(n, 0), {}};
    const Comparison missed = compare(chain, exact, none), invented = compare(chain, exact, all);
    EXPECT_EQ(missed.worst_margin, 0);
    EXPECT_EQ(missed.examples.size(), Comparison::shown);
    EXPECT_EQ(missed.missing, exact.pair_count);
    EXPECT_EQ(invented.worst_margin, aside == 0 ? 0 : margin(chain[n - 2], chain[n - 1])) << aside;
    // Those that touch, in place of none, and the last one.
    Answer nothing = exact;
    nothing.pairs.clear(), nothing.pair_count = 0, nothing.count.assign(n, 0);
    const Comparison of_all = compare(chain, nothing, all);
    EXPECT_EQ(of_all.worst_margin, margin(chain[n - 2], chain[n - 1])) << aside;
    EXPECT_EQ(of_all.examples.size(), Comparison::shown);
  }
}

TEST_F(Compare, CountsOnly) {
  const Answer counts = find(chain, {Request::Want::counts});
  found.pairs.clear();
  EXPECT_TRUE(compare(chain, counts, found).right());
  ++found.count[7];
  EXPECT_EQ(compare(chain, counts, found).wrong_counts, 1u);
}

TEST_F(Compare, AnEmptyAnswerIsNotRight) {
  found = {false, 0, std::vector<std::uint32_t>(100, 0), {}};
  EXPECT_EQ(compare_now().missing, 98u);
  EXPECT_FALSE(compare_now().right());
}

}  // namespace
}  // namespace catena::reference

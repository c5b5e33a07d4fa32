#include "catena/core/strategy/strand_table.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {
namespace {

StrandTable table(const char* strands) {
  return StrandTable(Parameters("test", {strands_parameter()}, strands));
}

/// A line of spheres, so that an arc window tells as many apart as an index window.
Chain line(Strands strands, Exclusion rule) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 12; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 1});
  return Chain(std::move(spheres), std::move(strands), std::move(rule));
}

/// Whoever reads it finds the same neighbours, by every rule, and where it was not made too.
TEST(StrandTable, ChangesNobodysNeighbours) {
  Exclusion joints = Exclusion::index(2);
  joints.extra_pairs = {{1, 9}, {0, 11}};
  std::size_t neighbours = 0, others = 0;
  for (const Exclusion& rule : {Exclusion::index(1), Exclusion::index(5), Exclusion::arc(1.7), joints})
    for (const Strands& strands : {Strands{}, Strands::one_closed(12), Strands{{0, 5, 12}, {0, 1}}}) {
      const Chain chain = line(strands, rule);
      StrandTable read = table("strands=read"), known = table("");
      const ChainView by_table = read.seen(chain.view()), as_it_is = known.seen(chain.view());
      EXPECT_FALSE(by_table.exclusion.one_open_strand);
      EXPECT_FALSE(by_table.exclusion.window_alone);
      EXPECT_EQ(as_it_is.exclusion.one_open_strand, strands.first.empty());
      for (std::uint32_t i = 0; i < chain.size(); ++i)
        for (std::uint32_t j = 0; j < chain.size(); ++j) {
          if (i == j) continue;
          const bool right = chain.view().neighbours(i, j);
          EXPECT_EQ(by_table.neighbours(i, j), right) << i << ' ' << j;
          EXPECT_EQ(as_it_is.neighbours(i, j), right) << i << ' ' << j;
          ++(right ? neighbours : others);
        }
    }
  EXPECT_GT(neighbours, 100u);
  EXPECT_GT(others, 100u);
}

TEST(StrandTable, SaysWhetherItIsLeftOut) {
  const auto told = [](const char* strands, const Strands& of) {
    const Chain chain = line(of, {});
    StrandTable of_test = table(strands);
    of_test.seen(chain.view());
    const Decision decision = of_test.told();
    return std::pair(decision.left_out, decision.reason);
  };
  using Told = std::pair<bool, std::string>;
  EXPECT_EQ(told("", {}), Told(true, "one open strand"));
  EXPECT_EQ(told("strands=read", {}), Told(false, "one open strand; its table is read all the same"));
  EXPECT_EQ(told("", Strands::one_closed(12)), Told(false, "one strand, which is closed"));
  EXPECT_EQ(told("", {{0, 5, 12}, {}}), Told(false, "2 strands"));
}

/// It serves a longer chain after a shorter one, and the other way round.
TEST(StrandTable, IsOfTheChainThatIsSeen) {
  StrandTable read = table("strands=read");
  for (const std::uint32_t n : {3u, 12u, 5u}) {
    const Chain chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1}));
    const ChainView seen = read.seen(chain.view());
    EXPECT_EQ(seen.exclusion.strand_first[1], n);
    EXPECT_EQ(seen.exclusion.strand_of[n - 1], 0u);
  }
}

}  // namespace
}  // namespace catena

#include "catena/core/readers/chain_format.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <sstream>

#include "catena/core/chain/joints.h"
#include "catena/core/readers/curve_graph.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/readers/test_graph.h"

namespace catena {
namespace {

Chain chain_of(CurveFile curves) {
  return Chain(std::move(curves.spheres), {curves.strand_first, curves.strand_closed}, curves.exclusion);
}

std::string text_of(const Chain& chain) {
  std::ostringstream out;
  write_chain(out, chain);
  return out.str();
}

bool same(const Chain& a, const Chain& b) {
  const auto bits = [](const Chain& chain) {
    std::vector<std::array<std::uint32_t, 4>> all;
    for (const Sphere& s : chain.spheres()) all.push_back(std::bit_cast<std::array<std::uint32_t, 4>>(s));
    return all;
  };
  const Exclusion &x = a.exclusion(), &y = b.exclusion();
  return bits(a) == bits(b) && a.strands().first == b.strands().first &&
         a.strands().closed == b.strands().closed && x.rule == y.rule && x.window == y.window &&
         std::bit_cast<std::uint64_t>(x.factor) == std::bit_cast<std::uint64_t>(y.factor) &&
         x.extra_pairs == y.extra_pairs;
}

Chain any_chain() {
  std::vector<Sphere> spheres;
  Strands strands{{0}, {}};
  for (auto left = *rc::gen::inRange(1, 5); left > 0; --left) {
    for (auto more = *rc::gen::inRange(0, 6); more > 0; --more)
      spheres.push_back({*any_finite(), *any_finite(), *any_finite(), std::abs(*any_finite())});
    strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
    strands.closed.push_back(*rc::gen::arbitrary<bool>());
  }
  Exclusion exclusion = *rc::gen::arbitrary<bool>()
                            ? Exclusion::index(*rc::gen::inRange<std::uint32_t>(1, ~0u))
                            : Exclusion::arc(1);
  if (exclusion.rule == Exclusion::Rule::arc_window)
    exclusion.factor =
        *rc::gen::suchThat(rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                                        [](std::uint64_t b) { return std::bit_cast<double>(b); }),
                           [](double value) { return std::isfinite(value) && value > 0; });
  const auto n = static_cast<std::uint32_t>(spheres.size());
  if (n > 1)
    for (auto pairs = *rc::gen::inRange(0, 4); pairs > 0; --pairs) {
      const auto i = *rc::gen::inRange<std::uint32_t>(0, n), step = *rc::gen::inRange<std::uint32_t>(1, n);
      exclusion.extra_pairs.push_back({i, (i + step) % n});
    }
  return Chain(std::move(spheres), std::move(strands), std::move(exclusion));
}

RC_GTEST_PROP(ChainFormat, BringsEveryChainBackBitForBit, ()) {
  const Chain chain = any_chain();
  const CurveFile read = read_text("a.chain", text_of(chain));
  RC_ASSERT(same(chain_of(read), chain));
  RC_ASSERT(read.rounding.greatest_error() == 0);
}

RC_GTEST_PROP(ChainFormat, RefusesEveryTruncation, ()) {
  const std::string text = text_of(any_chain());
  const auto size = *rc::gen::inRange<std::size_t>(0, text.size() - 1);  // the last line end may be missing
  RC_ASSERT(complaint("a.chain", text.substr(0, size)) != "");
}

// Pairs that a user names and joints of a file stand side by side.
TEST(ChainFormat, HoldsPairsAndJointsBoth) {
  const Strands strands{{0, 2, 4}, {0, 0}};
  const std::vector<Pair> joints{{1, 2}};
  const std::vector<Sphere> spheres{{0, 0, 0, 1}, {2, 0, 0, 1}, {4, 0, 0, 1}, {6, 0, 0, 1}};
  Exclusion rule = Exclusion::index(1);
  rule.extra_pairs = pairs_across_joints(spheres, strands, joints, rule);
  rule.extra_pairs.push_back({0, 3});
  std::ostringstream out;
  write_chain(out, Chain(spheres, strands, rule), joints);
  EXPECT_TRUE(out.str().ends_with("pairs 1\n0 3\njoints 1\n1 2\nend\n")) << out.str();
}

// What a reader makes of a graph: steps and joints come back, and under every rule the same neighbours with
// them.
RC_GTEST_PROP(ChainFormat, BringsJointsBack, ()) {
  const TestGraph graph = any_graph();
  CurveFile curves;
  curves.spheres = graph.points;
  arrange_along_edges(curves, graph.edges, true);
  const Strands strands{curves.strand_first, curves.strand_closed};
  Exclusion rule = *rc::gen::arbitrary<bool>() ? Exclusion::index(*rc::gen::inRange<std::uint32_t>(1, 4))
                                               : Exclusion::arc(1.5);
  rule.extra_pairs = pairs_across_joints(curves.spheres, strands, curves.joints, rule);
  const Chain chain(curves.spheres, strands, rule);
  std::ostringstream out;
  write_chain(out, chain, curves.joints);
  RC_ASSERT(out.str().find("pairs ") == std::string::npos);
  CurveFile again = read_text("a.chain", out.str());
  RC_ASSERT(again.joints == curves.joints);
  again.exclusion.extra_pairs = pairs_across_joints(again.spheres, strands, again.joints, again.exclusion);
  RC_ASSERT(same(chain_of(again), chain));
}

TEST(ChainFormat, BringsChainsWithoutSpheresBack) {
  EXPECT_TRUE(same(chain_of(read_text("a.chain", text_of(Chain()))), Chain()));
}

TEST(ChainFormat, ReadsItsExample) {
  const Chain chain = chain_of(ReaderRegistry::instance().read(example("rings.chain")));
  EXPECT_EQ(chain.size(), 11u);
  EXPECT_EQ(chain.strand_count(), 3u);
  EXPECT_TRUE(chain.neighbours(0, 8));
  EXPECT_TRUE(chain.neighbours(0, 3));
  EXPECT_FALSE(chain.neighbours(0, 6));
}

TEST(ChainFormat, ComplainsWithFileAndLine) {
  const std::string start = "catena-chain 1\n";
  EXPECT_COMPLAINT("1: the file does not start with", "a.chain", "hello\n");
  EXPECT_COMPLAINT("1: version '2'", "a.chain", "catena-chain 2\nend\n");
  EXPECT_COMPLAINT("2: the file is truncated", "a.chain", start + "window 1\n");
  EXPECT_COMPLAINT("3: the file is truncated: it ends where a sphere", "a.chain",
                   start + "strand open 2\n0 0 0 1\n");
  EXPECT_COMPLAINT("3: a sphere is 'x y z radius', got 3", "a.chain", start + "strand open 1\n0 0 0\nend\n");
  EXPECT_COMPLAINT("2: number of spheres 4000000000 is more", "a.chain", start + "strand open 4000000000\n");
  EXPECT_COMPLAINT("2: a strand is open or closed, not 'ajar'", "a.chain", start + "strand ajar 0\n");
  EXPECT_COMPLAINT("3: radius '-1' is negative", "a.chain", start + "strand open 1\n0 0 0 -1\nend\n");
  EXPECT_COMPLAINT("3: a second exclusion rule", "a.chain", start + "window 1\narc_window 2\nend\n");
  EXPECT_COMPLAINT("2: the window must be at least 1", "a.chain", start + "window 0\nend\n");
  for (const char* none : {"-1", "0", "-0"})
    EXPECT_COMPLAINT("2: the arc_window must be above 0", "a.chain",
                     start + "arc_window " + none + "\nend\n");
  EXPECT_COMPLAINT("3: pair 0 1 does not name two of the spheres, of which there are 1", "a.chain",
                   start + "pairs 1\n0 1\nstrand open 1\n0 0 0 1\nend\n");
  EXPECT_COMPLAINT("3: pair 0 1 does not name two of the spheres, of which there are 1", "a.chain",
                   start + "joints 1\n0 1\nstrand open 1\n0 0 0 1\nend\n");
  EXPECT_COMPLAINT("3: sphere 5 cannot be its own neighbour", "a.chain", start + "pairs 1\n5 5\nend\n");
  EXPECT_COMPLAINT("2: 'end 1': expected 'window K'", "a.chain", start + "end 1\n");
  EXPECT_COMPLAINT("4: there is more after 'end'", "a.chain", start + "strand open 0\nend\nend\n");
}

TEST(ChainFormat, SaysWhereItCannotWrite) {
  EXPECT_THROW(write_chain(std::filesystem::path("/no such folder/a.chain"), Chain()), InputError);
  std::ostringstream full;
  full.setstate(std::ios::badbit);
  EXPECT_THROW(write_chain(full, Chain()), InputError);
}

}  // namespace
}  // namespace catena

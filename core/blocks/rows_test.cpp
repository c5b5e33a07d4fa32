#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/chain/chain.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/shapes.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/certificate.h"
#include "catena/reference/evidence_tree.h"
#include "catena/reference/verify.h"

namespace catena {
namespace {

std::vector<Pair> pairs_of(Variant& variant, const Chain& chain) {
  Collisions found;
  variant.build(chain);
  variant.find(chain, {}, found);
  properties::sort(found.pairs);
  return found.pairs;
}

/// Spheres and blocks of a tree that follow one another along a line, up or down it, are not looked for
/// beyond the next: unless a thicker one reaches there, or a jump leads back, wherever that is among them.
TEST(Rows, EndWhereAThickSphereReachesBeyondTheNext) {
  const auto tree = StrategyRegistry::instance().make("ChainTree"),
             judge = StrategyRegistry::instance().make("CPU1");
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    properties::Dice dice(seed);
    const float way = dice.pick({-1.0f, 1.0f});
    const std::uint32_t jumps = dice.pick({20u, 100u, 1000u});
    // Many little thicker ones disturb the order of spheres, few much thicker ones that of blocks.
    const bool little = dice.one_in(2);
    const std::uint32_t thick = little ? 8 : dice.pick({20u, 60u, 200u});
    std::vector<Sphere> spheres(40 + dice.below(little ? 60 : 260));
    float x = 0;
    for (Sphere& s : spheres) {
      x += way * (dice.one_in(jumps) ? 16 * dice.symmetric() : 1.0f);
      s = {x, 0, 0, dice.one_in(thick) ? (little ? 2.5f : 24.0f) * dice.unit() : 0.25f};
    }
    const Chain chain(std::move(spheres));
    ASSERT_EQ(pairs_of(*tree, chain), pairs_of(*judge, chain)) << "seed " << seed;
    std::uint64_t proved = 0;
    const auto v = reference::verify_by_certificate(*tree, chain, 1u << 24, proved);
    ASSERT_EQ(v.verdict, reference::Verdict::exact) << v.reason << ", seed " << seed;
  }
}

/// Every block ends before the next but one begins, and yet the fourth lies in the first: they go forth and
/// back.
TEST(Rows, AreNotOfTwoWaysSideBySide) {
  const auto tree = StrategyRegistry::instance().make("ChainTree"),
             judge = StrategyRegistry::instance().make("CPU1");
  for (const float way : {-1.0f, 1.0f})
    for (const std::uint32_t more : {0u, 4000u}) {  // a node alone, or one of many
      std::vector<Sphere> spheres;
      const auto block = [&](float from, float step, float radius) {
        for (int k = 0; k < 8; ++k)
          spheres.push_back({way * (from + step * static_cast<float>(k)), 0, 0, radius});
      };
      block(-60, 8, 3);
      for (int k = 1; k < 16; ++k)
        k % 2 == 1 ? block(-110 + 30 * static_cast<float>(k - 1), 1, 0.25f)
                   : block(20 * static_cast<float>(k), 1, 0.25f);
      for (std::uint32_t k = 0; k < more; ++k)
        spheres.push_back({way * (1000 + static_cast<float>(k)), 0, 0, 0.25f});
      const Chain chain(std::move(spheres));
      const std::vector<Pair> right = pairs_of(*judge, chain);
      ASSERT_GT(right.size(), 4u);
      EXPECT_EQ(pairs_of(*tree, chain), right) << way << ' ' << more;
    }
}

/// Under an arc window the spheres of ordered blocks may collide with the next: within a block, and from one
/// to the other.
TEST(Rows, HaveThePairsOfSpheresNextToOneAnother) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 300; ++i) spheres.push_back({1.5f * static_cast<float>(i), 0, 0, 1});
  const Chain chain(std::move(spheres), {}, Exclusion::arc(0.5));
  for (const char* name : {"Hybrid", "ChainTree"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    variant->build(chain);
    variant->find(chain, {}, found);
    properties::sort(found.pairs);
    ASSERT_EQ(found.pairs.size(), 299u) << name;
    for (std::uint32_t i = 0; i < 299; ++i) EXPECT_EQ(found.pairs[i], (Pair{i, i + 1})) << name;
  }
}

/// Blocks of neighbours alone, which evidence tells of all the same; and of two windows the numbers that come
/// after the greatest are 0 and 1.
TEST(Rows, LeaveOutNeighboursHoweverWideTheWindow) {
  properties::Dice dice(1);
  const std::vector<Sphere> spheres = properties::tangle(dice, 600);
  for (const std::uint32_t window : {6u, 7u, 14u, 15u, 16u, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
    const Chain chain(spheres, {}, Exclusion::index(window));
    for (const char* name : {"Hybrid", "ChainTree"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      std::uint64_t proved = 0;
      const auto v = reference::verify_by_certificate(*variant, chain, 1u << 24, proved);
      EXPECT_EQ(v.verdict, reference::Verdict::exact) << name << ", window " << window << ": " << v.reason;
      EXPECT_EQ(proved > 0, window < 600) << name << ", window " << window;
    }
  }
}

/// What they leave out is accounted for, and a row that is none is found by that alone: nothing is said of
/// the pairs that the search reports.
TEST(Rows, AreProvedByWhatTheyLeaveOut) {
  const auto report_of = [](const Chain& chain, bool all_in_rows) {
    BlockTree tree;
    build_block_tree(chain.view(), tree, Team());
    EXPECT_GT(tree.rows(), 0u);
    for (std::size_t l = 0; all_in_rows && l < tree.level.size(); ++l)
      for (std::uint32_t k = 0; k < tree.level[l].count; ++k) {
        const auto bit = static_cast<std::uint16_t>(1u << k % BlockTree::group);
        tree.level[l].in_a_row[k / BlockTree::group] |= bit;
        if (k + 1 < tree.level[l].count) tree.level[l].with_the_next[k / BlockTree::group] |= bit;
      }
    reference::EvidenceTree nodes(chain);
    show_blocks(chain.view(), tree, nodes);
    nodes.complete();
    reference::CertificateChecker checker(chain, nodes, Accounting::each_pair, {});
    BlockQueues queues;
    Collisions found;
    PairCollector collector(chain.size(), {}, found);
    const ChainView view = chain.view();
    const BlockEvidence evidence(view, tree, checker);
    search_blocks(view, tree, queues, collector.lane(0), &evidence);
    return checker.report();
  };
  // A hairpin: straight there and back; of two nodes side by side each is in a row, and the turn in none.
  for (const std::uint32_t half : {256u, 3000u}) {
    std::vector<Sphere> there, hairpin;
    for (std::uint32_t k = 0; k < 2 * half; ++k) {
      const auto at = static_cast<float>(k < half ? k : 2 * half - 1 - k);
      there.push_back({1.5f * static_cast<float>(k), 0, 0, 1});
      hairpin.push_back({1.5f * at, k < half ? 0.0f : 1.9f, 0, 1});
    }
    const Chain rod(std::move(there)), bent(std::move(hairpin));
    const auto of_rod = report_of(rod, false), of_bent = report_of(bent, false),
               spoilt = report_of(bent, true);
    EXPECT_TRUE(of_rod.holds()) << of_rod.fault();
    EXPECT_TRUE(report_of(rod, true).holds()) << "all of it is in a row";
    EXPECT_TRUE(of_bent.holds()) << of_bent.fault();
    EXPECT_GT(of_rod.discarded, 0u);
    EXPECT_GT(spoilt.not_separate, 0u) << half;
    EXPECT_TRUE(spoilt.each_once) << half;
  }
}

/// A pair among the first blocks ends a search for any before the others are looked into.
TEST(Rows, EndWithTheFirstPairWhereAnyWillDo) {
  const Chain coil = SceneRegistry::instance().open("coil:n=20000")->frame(0);
  std::vector<Sphere> spheres(coil.spheres().begin(), coil.spheres().end());
  spheres[12] = spheres[3];  // of the next block
  const Chain chain(std::move(spheres));
  const auto variant = StrategyRegistry::instance().make("ChainTree");
  const auto looked_into = [&](Request::Want want) {
    Collisions found;
    variant->build(chain);
    variant->find(chain, {want}, found);
    EXPECT_TRUE(found.found);
    const auto work = variant->work();
    const auto step = std::ranges::find(work, "eight spheres, eight", &WorkDone::step);
    EXPECT_NE(step, work.end());
    return step == work.end() ? 0 : step->times;
  };
  EXPECT_LT(100 * looked_into(Request::Want::any), looked_into(Request::Want::counts));
}

}  // namespace
}  // namespace catena

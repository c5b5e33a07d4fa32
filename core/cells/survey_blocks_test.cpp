#include "catena/core/cells/survey_blocks.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "catena/core/cells/host_block_nodes.h"
#include "catena/core/executor/host_group.h"

namespace catena {
namespace {

/// Balls as blocks, so many at one place and the next ones far from them; the one `step` further on, around,
/// comes next in the chain.
class Survey {
 public:
  Survey(std::uint32_t blocks, std::uint32_t together, std::uint32_t asked, bool in_cells, float ratio = 1,
         std::uint32_t step = 1) {
    ChainView chain{};
    chain.size = blocks * CapsuleBlocks::block;
    chain.extent.least_radius = 1, chain.extent.greatest_radius = ratio;
    blocks_ = CapsuleBlocks::of(chain, CapsuleBlocks::most_partners, 1, 0, in_cells ? 0 : ~0u, asked);
    for (std::uint32_t b = 0; b < blocks; ++b)
      capsule_.push_back(
          BlockCapsule::around({10.0f * static_cast<float>(b * step % blocks / together), 0, 0, 1}, false));
    // Behind the last, where nobody is to look.
    capsule_.resize(blocks + BlockNodes::children, capsule_.back());
    shape_.resize(capsule_.size());
    blocks_.capsule = capsule_.data(), blocks_.shape = shape_.data(), blocks_.state = &state_;
    const BlockNodes& nodes = nodes_.fit(blocks_);
    BlockSurvey::Memory memory;
    for (std::uint32_t k = 0; k < blocks_.surveyed; ++k)
      BlockSurvey(nodes, blocks_, memory).ask(HostGroup(32), k);
  }
  std::vector<std::uint32_t> counted() const {
    const auto said = CapsuleBlocks::Survey::of(state_.survey);
    EXPECT_EQ(said.asked, blocks_.surveyed);
    return {said.crowded, said.others, said.partners};
  }
  bool all_left() const { return blocks_.all_left(); }

 private:
  CapsuleBlocks::State state_{};
  CapsuleBlocks blocks_{};
  HostBlockNodes nodes_;
  std::vector<BlockCapsule> capsule_;
  std::vector<std::uint8_t> shape_;
};
using Counted = std::vector<std::uint32_t>;

TEST(BlockSurvey, CountsWhomEachMeetsAndWhoMeetsTooMany) {
  constexpr std::uint32_t most = CapsuleBlocks::most_partners;
  for (const bool in_cells : {false, true}) {
    EXPECT_EQ(Survey(1, 1, 64, in_cells).counted(), (Counted{0, 1, 0}));
    EXPECT_EQ(Survey(9, 1, 64, in_cells).counted(), (Counted{0, 9, 0}));
    EXPECT_EQ(Survey(9, 3, 64, in_cells).counted(), (Counted{0, 9, 18}));
    EXPECT_EQ(Survey(most + 1, 99, 64, in_cells).counted(), (Counted{0, most + 1, (most + 1) * most}));
    EXPECT_EQ(Survey(most + 2, 99, 64, in_cells).counted(), (Counted{most + 2, 0, 0}));
    EXPECT_EQ(Survey(8000, 4, 64, in_cells).counted(), (Counted{0, 64, 192}));
    EXPECT_EQ(Survey(8000, 4, 0, in_cells).counted(), (Counted{0, 0, 0}));
  }
}

TEST(BlockSurvey, DoesNotKnowOfTangledBlocksThatAreLookedForInCells) {
  constexpr std::uint32_t full = BlockSurvey::room * BlockNodes::children;
  EXPECT_EQ(Survey(full, full, 64, true).counted(), (Counted{64, 0, 0}));
  EXPECT_EQ(Survey(full + 1, full + 1, 64, true).counted(), (Counted{0, 0, 0}));
  EXPECT_EQ(Survey(full + 1, full + 1, 64, false).counted(), (Counted{64, 0, 0}));
}

/// Where each node's box holds nearly all, though no two blocks meet.
TEST(BlockSurvey, TakesForTangledWhoMeetsMoreNodesThanIsWorthWhile) {
  constexpr std::uint32_t children = BlockNodes::children, most = BlockSurvey::room / 4 * children;
  const auto counted = [](std::uint32_t blocks, bool in_cells) {
    return Survey(blocks, 1, 64, in_cells, 1, blocks / children + 1).counted();
  };
  EXPECT_EQ(counted(most, false), (Counted{0, 64, 0}));
  EXPECT_EQ(counted(most + 64, true), (Counted{0, 64, 0}));
  const Counted more = counted(most + 64, false);
  EXPECT_GT(more[0], 48u);
  EXPECT_EQ(more[0] + more[1], 64u);
}

/// One of each part, and not of all at the same place, as what comes again in a chain may do so with the
/// parts.
TEST(BlockSurvey, AsksBlocksOfAllPartsOfTheChain) {
  constexpr std::uint32_t asked = 64;
  for (const std::uint32_t blocks : {asked, asked + 1, 2 * asked - 1, 100 * asked}) {
    ChainView chain{};
    chain.size = blocks * CapsuleBlocks::block;
    const CapsuleBlocks of = CapsuleBlocks::of(chain, 8, 1, 0, 0, asked);
    ASSERT_EQ(of.surveyed, asked);
    std::set<std::uint32_t> places;
    for (std::uint32_t k = 0; k < asked; ++k) {
      const std::uint32_t b = of.surveyed_block(k), first = blocks * k / asked;
      EXPECT_GE(b, first) << k << " of " << blocks;
      EXPECT_LT(b, blocks * (k + 1) / asked) << k << " of " << blocks;
      places.insert(b - first);
    }
    if (blocks == 100 * asked) {
      EXPECT_GT(places.size(), 30u);
    }
  }
}

TEST(BlockSurvey, LeavesAllWhereNobodyHasFewPartners) {
  EXPECT_TRUE(Survey(100, 100, 64, false).all_left());
  EXPECT_TRUE(Survey(100, 100, 64, true).all_left());
  EXPECT_FALSE(Survey(100, 100, 0, false).all_left());
  EXPECT_FALSE(Survey(102, 3, 64, false).all_left());  // each has two partners, and none is crowded
  EXPECT_TRUE(Survey(100, 4, 64, false).all_left());
  EXPECT_FALSE(Survey(100, 100, 64, false, 1000).all_left());  // radii are unlike
}

/// By what a block that has few partners saves, and one that is crowded took in vain; of known blocks only,
/// which are to be half of those asked.
TEST(BlockSurvey, LeavesAllWhereTheOtherSearchTakesLess) {
  struct Case {
    std::uint32_t crowded, others, partners;
    bool left;
  };
  for (const Case& c :
       {Case{0, 0, 0, false}, Case{0, 64, 256, false}, Case{0, 64, 257, true}, Case{32, 32, 64, false},
        Case{32, 32, 65, true}, Case{42, 22, 4, false}, Case{42, 22, 5, true}, Case{64, 0, 0, true},
        Case{31, 0, 0, false}, Case{32, 0, 0, true}, Case{0, 31, 248, false}, Case{0, 32, 248, true}}) {
    CapsuleBlocks::State state{};
    state.survey = CapsuleBlocks::Survey{64, c.crowded, c.others, c.partners}.number();
    CapsuleBlocks blocks{};
    blocks.surveyed = 64, blocks.many_partners = 64, blocks.alike = true, blocks.state = &state;
    EXPECT_EQ(blocks.all_left(), c.left) << c.crowded << ' ' << c.others << ' ' << c.partners;
    EXPECT_EQ(blocks.left_by_now().all, c.left) << c.crowded << ' ' << c.others << ' ' << c.partners;
    EXPECT_TRUE(blocks.left_by_now().known);
    blocks.alike = false;
    EXPECT_FALSE(blocks.all_left()) << c.crowded << ' ' << c.others << ' ' << c.partners;
    EXPECT_FALSE(blocks.left_by_now().all) << c.crowded << ' ' << c.others << ' ' << c.partners;
  }
}

/// Of few blocks those with fewer partners are worth leaving.
TEST(BlockSurvey, AsksForMorePartnersWhereThereAreMoreBlocks) {
  const auto many = [](std::uint32_t spheres) {
    ChainView chain{};
    chain.size = spheres;
    return CapsuleBlocks::of(chain, 8, 1, 0, 0, 64).many_partners;
  };
  EXPECT_EQ(many(100), 38u);
  EXPECT_EQ(many(1'000'000), 38u);
  EXPECT_EQ(many(2'000'000), 51u);
  EXPECT_EQ(many(3'000'000), 64u);
  EXPECT_EQ(many(1'000'000'000), 64u);
  // Three partners each.
  EXPECT_TRUE(Survey(20'000, 4, 64, false).all_left());
  EXPECT_FALSE(Survey(80'000, 4, 64, false).all_left());
}

/// Whoever goes by what is known finds nobody: it must be so at the end, whatever the others will say. (Half
/// of them may say what all together do not.)
TEST(BlockSurvey, SaysNothingBeforeItIsCertain) {
  std::mt19937 random(7);
  int early = 0, left = 0, kept = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const std::uint32_t crowded = below(101), unknown = below(3) == 0 ? below(60) : 0, most = 1 + below(9);
    CapsuleBlocks::State state{};
    CapsuleBlocks blocks{};
    blocks.surveyed = 1 + below(64), blocks.alike = true, blocks.state = &state;
    blocks.many_partners = 16 + below(49);
    bool certain = false;  // before the last has spoken
    for (std::uint32_t k = 0; k < blocks.surveyed; ++k) {
      CapsuleBlocks::Survey said{1, 0, 0, 0};
      if (below(100) < crowded)
        said.crowded = 1;
      else if (below(100) >= unknown)
        said.others = 1, said.partners = below(most);
      add(&state.survey, said.number());
      const CapsuleBlocks::Left now = blocks.left_by_now();
      EXPECT_EQ(now.known, now.all || k + 1 == blocks.surveyed);
      certain |= now.all && k + 1 < blocks.surveyed;
    }
    EXPECT_EQ(blocks.left_by_now().all, blocks.all_left());
    if (certain) {
      EXPECT_TRUE(blocks.all_left());
    }
    early += certain, left += blocks.all_left(), kept += !blocks.all_left();
  }
  EXPECT_GT(early, 100);
  EXPECT_GT(left, 100);
  EXPECT_GT(kept, 100);
}

}  // namespace
}  // namespace catena

#include "catena/core/cells/find_partners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "catena/core/cells/host_block_nodes.h"
#include "catena/core/executor/host_group.h"

namespace catena {
namespace {

/// Blocks of which only the capsules are there, in any order, in a tree; every one that is not tangled meets
/// whom it does.
class Partners {
 public:
  /// `said`: by the blocks of a survey, of how many.
  Partners(std::vector<BlockCapsule> capsules, std::uint32_t crowd, bool in_cells,
           CapsuleBlocks::Survey said = {0, 0, 0, 0}, std::uint32_t surveyed = 0)
      : capsule_(std::move(capsules)) {
    const auto n = static_cast<std::uint32_t>(capsule_.size());
    ChainView chain{};
    chain.size = n * CapsuleBlocks::block;
    chain.extent.least_radius = chain.extent.greatest_radius = 1;
    blocks_ = CapsuleBlocks::of(chain, crowd, 1, 0, in_cells ? 0 : ~0u, surveyed);
    shape_.resize(n), partners_.resize(n), met_.resize(n), partner_.resize(CapsuleBlocks::most_partners * n);
    blocks_.capsule = capsule_.data(), blocks_.shape = shape_.data(), blocks_.partners = partners_.data();
    blocks_.met = met_.data(), blocks_.partner = partner_.data(), blocks_.state = &state_;
    const BlockNodes& nodes = nodes_.fit(blocks_);
    PartnerSearch::Memory memory;
    for (const std::uint32_t threads : {32u, 1u, 128u}) {  // and each time the same
      std::fill(shape_.begin(), shape_.end(), std::uint8_t{0});
      std::fill(partners_.begin(), partners_.end(), untold);
      state_ = {}, state_.survey = said.number();
      HostGroup group(threads);
      for (std::uint32_t k = 0; k < nodes.count[2]; ++k) PartnerSearch(nodes, blocks_, memory).find(group, k);
      told = static_cast<std::uint32_t>(partners_.size() -
                                        std::count(partners_.begin(), partners_.end(), untold));
      if (told > 0) check(NodeMeeting(nodes, blocks_));
      EXPECT_EQ(state_.any != 0, crowded > 0 || (tangled > 0 && !in_cells));
      EXPECT_EQ(state_.listed != 0, in_cells && crowded + tangled > 0);
    }
  }

  std::uint32_t told = 0, crowded = 0, tangled = 0, pairs = 0;  ///< crowded by what it met

 private:
  static constexpr std::uint32_t untold = 12345;

  void check(const NodeMeeting& meeting) {
    crowded = tangled = pairs = 0;
    for (std::uint32_t b = 0; b < blocks_.blocks; ++b) {
      std::vector<std::uint32_t> others;
      for (std::uint32_t other = 0; other < blocks_.blocks; ++other)
        if (meeting.may_meet(0, b, other)) others.push_back(other);
      const bool in_cells = blocks_.tangled(b);
      if (in_cells ? partners_[b] == 0 : partners_[b] > blocks_.crowd && others.size() <= blocks_.crowd) {
        ++tangled;
        continue;
      }
      pairs += static_cast<std::uint32_t>(others.size());
      if (others.size() > blocks_.crowd) {
        ++crowded;
        EXPECT_GT(partners_[b], blocks_.crowd) << b;
        EXPECT_EQ(in_cells, blocks_.in_cells) << b;
        EXPECT_NE(state_.any, 0u);
        continue;
      }
      ASSERT_EQ(partners_[b], others.size()) << b;
      std::vector<std::uint32_t> found(partner_.begin() + b * CapsuleBlocks::most_partners,
                                       partner_.begin() + b * CapsuleBlocks::most_partners + partners_[b]);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, others) << b;
    }
  }

  std::vector<BlockCapsule> capsule_;
  std::vector<std::uint8_t> shape_;
  std::vector<std::uint32_t> partners_, met_, partner_;
  CapsuleBlocks::State state_{};
  CapsuleBlocks blocks_{};
  HostBlockNodes nodes_;
};

BlockCapsule capsule(float x, float y, float z, float half_x, float radius) {
  BlockCapsule c = BlockCapsule::around({x, y, z, radius}, false);
  c.half = {half_x, 0, 0}, c.reach = c.radius + half_x;
  return c;
}

/// In the order of the chain, beside one another and one turn further on.
std::vector<BlockCapsule> wound(std::uint32_t blocks, std::uint32_t turn, float apart) {
  std::vector<BlockCapsule> result;
  for (std::uint32_t b = 0; b < blocks; ++b)
    result.push_back(
        capsule(10.0f * static_cast<float>(b % turn), apart * static_cast<float>(b / turn), 0, 5, 1));
  return result;
}

TEST(PartnerSearch, FindsAllThatBlocksMeetAlongAChain) {
  for (const bool in_cells : {false, true})
    for (const std::uint32_t blocks : {1u, 2u, 7u, 8u, 9u, 63u, 64u, 65u, 500u, 4097u}) {
      const Partners lone(wound(blocks, 40, 2.5f), 8, in_cells),
          touching(wound(blocks, 40, 1.9f), 8, in_cells);
      EXPECT_EQ(lone.tangled + lone.crowded + touching.tangled + touching.crowded, 0u) << blocks;
      EXPECT_GE(touching.pairs, lone.pairs);
      EXPECT_EQ(touching.pairs > lone.pairs, blocks > 40);
    }
}

TEST(PartnerSearch, KnowsWhoMeetsMoreThanItMay) {
  for (const bool in_cells : {false, true})
    for (const std::uint32_t crowd : {0u, 2u, 8u}) {
      std::vector<BlockCapsule> capsules;
      for (std::uint32_t k = 0; k < 300; ++k)  // groups of 1 to 12 at a place
        for (std::uint32_t j = 0; j <= k % 12; ++j)
          capsules.push_back(capsule(20.0f * static_cast<float>(k), 0, 0, 2, 1));
      const Partners found(capsules, crowd, in_cells);
      EXPECT_EQ(found.tangled, 0u);
      EXPECT_GT(found.crowded, 100u);
      EXPECT_LT(found.crowded, capsules.size());
    }
}

/// Blocks of a lattice in any order: every node may meet all others, whether these are as many as one may go
/// on with or more. None that is not told to be tangled lacks a partner.
TEST(PartnerSearch, LosesNobodyWhereNodesMeetAsManyAsTheyMayOrMore) {
  std::mt19937 random(3);
  for (const bool in_cells : {false, true})
    for (const std::uint32_t nodes : {31u, 32u, 33u, 34u, 64u, 127u, 128u, 129u, 255u, 256u, 257u, 700u}) {
      std::vector<BlockCapsule> capsules;
      for (std::uint32_t b = 0; b < nodes * BlockNodes::children; ++b)
        capsules.push_back(capsule(8 * static_cast<float>(b % 16), 1.9f * static_cast<float>(b / 16 % 8),
                                   4 * static_cast<float>(b / 128), 3, 1));
      std::shuffle(capsules.begin(), capsules.end(), random);
      const Partners found(capsules, 8, in_cells);
      EXPECT_EQ(found.tangled, nodes > PartnerSearch::most_near ? capsules.size() : 0) << nodes;
      EXPECT_EQ(found.crowded, 0u) << nodes;
    }
}

/// Where the survey says so for certain nobody is looked for; else all are found, whether it has ended or
/// not.
TEST(PartnerSearch, FindsNobodyWhereAllIsLeftToTheOtherSearch) {
  using Said = CapsuleBlocks::Survey;
  for (const bool in_cells : {false, true})
    for (const float apart : {2.5f, 1.9f, 0.4f}) {  // the last one's nodes ask for the survey
      const auto blocks = wound(800, 40, apart);
      EXPECT_EQ(Partners(blocks, 8, in_cells, Said{64, 64, 0, 0}, 64).told, 0u);
      EXPECT_EQ(Partners(blocks, 8, in_cells, Said{50, 50, 0, 0}, 64).told, 0u);
      for (const Said& said :
           {Said{64, 10, 54, 0}, Said{0, 0, 0, 0}, Said{30, 30, 0, 0}, Said{63, 0, 63, 149}}) {
        const Partners asked(blocks, 8, in_cells, said, 64), alone(blocks, 8, in_cells);
        EXPECT_EQ(asked.told, blocks.size());
        EXPECT_EQ(asked.tangled, alone.tangled);
        EXPECT_EQ(asked.pairs, alone.pairs);
      }
    }
}

/// More pairs of nodes than are looked into together, and more pairs of blocks than that.
TEST(PartnerSearch, LooksIntoManyPairsOfNodesInRounds) {
  constexpr std::uint32_t together = PartnerSearch::Memory::together;
  for (const std::uint32_t nodes :
       {together / 8 - 1, together / 8, together / 8 + 1, 5u, 2 * together / 8, 33u}) {
    std::vector<BlockCapsule>
        capsules;  // of each node one at each of eight places, all nodes at the same ones
    for (std::uint32_t b = 0; b < nodes * BlockNodes::children; ++b)
      capsules.push_back(capsule(8 * static_cast<float>(b % 8), 0, 2.5f * static_cast<float>(b / 8), 3, 1));
    for (const float apart : {2.5f, 1.9f}) {
      for (std::uint32_t b = 0; b < capsules.size(); ++b)
        capsules[b].centre.z = apart * static_cast<float>(b / 8);
      const Partners found(capsules, 8, false);
      EXPECT_EQ(found.tangled + found.crowded, 0u) << nodes;
      EXPECT_GT(found.pairs, 0u);
    }
  }
}

}  // namespace
}  // namespace catena

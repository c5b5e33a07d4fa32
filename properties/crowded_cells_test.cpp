#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/cells/buckets.h"
#include "catena/core/cells/survey_blocks.h"
#include "catena/core/input/input.h"
#include "catena/properties/testing/rods.h"

// Blocks and spheres in crowds, at the limits of these, and one past them.
namespace catena::properties {
namespace {

/// A crowded block and the next one, of a coarser level, go on in order: what is adjacent is found once.
TEST(Cells, FindOnceWhatIsAdjacentToACrowdedBlock) {
  std::vector<Sphere> spheres;
  add_rod(spheres, 0, 0, 0);
  const float end = 1.6f * 15.5f;
  for (std::uint32_t k = 0; k < block; ++k)
    spheres.push_back({end + 1.6f + 4.0f * static_cast<float>(k), 0, 0, 1});
  for (std::uint32_t k = 0; k < CapsuleBlocks::most_partners + 2; ++k)
    add_rod(spheres, 4.0f * static_cast<float>(k) - 24, 0, 1.5f, true);
  expect_exact(each_block_a_strand(spheres), "a crowded rod that goes on with longer steps");
}

/// Few enough of all spheres are in a crowd, or one too many; as many spheres as fill warps, and one more.
TEST(Cells, ShareOutACrowdAmongAllWhoSearch) {
  for (const std::uint32_t crowd :
       {Buckets::crowd - 1, Buckets::crowd, Buckets::crowd + 1, 5 * Buckets::crowd})
    for (const std::uint32_t all : {8 * crowd - 1, 8 * crowd, 8 * crowd + 1, 1600u, 4097u}) {
      std::vector<Sphere> spheres;
      for (std::uint32_t k = 0; k < all; ++k) {
        const auto at = static_cast<float>(k);
        spheres.push_back(k < crowd ? Sphere{1 + at / 256, 1, 1, 1} : Sphere{1.6f * at, 100, 1, 1});
      }
      expect_exact(Chain(spheres, Strands{{0, crowd, all}, {}}),
                   std::to_string(crowd) + " of " + std::to_string(all) + " spheres in a crowd");
    }
}

/// Rods in bundles, of as many as a row of cells is looked through by one thread, or one more, or so many
/// that a group of blocks has no room for all that are near; what is next in the chain is in another bundle.
TEST(Cells, FindWhatTouchesInABundle) {
  for (const std::uint32_t in_bundle : {3u, 6u, 7u, 48u}) {
    const std::uint32_t bundles = 3072 / in_bundle, step = static_cast<std::uint32_t>(0.618 * bundles) | 1;
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < bundles * in_bundle; ++k) {
      const std::uint32_t bundle = k * step % bundles, rod = k / bundles;
      const auto at = [](std::uint32_t of_bundle, std::uint32_t of_rod) {
        return 256 * static_cast<float>(of_bundle) + 1.9f * static_cast<float>(of_rod) + 24;
      };
      add_rod(spheres, at(bundle % 16, 0), at(bundle / 16 % 16, rod % 7), at(bundle / 256, rod / 7));
    }
    expect_exact(each_block_a_strand(spheres), "bundles of " + std::to_string(in_bundle) + " rods");
  }
}

/// How many blocks a search on the host left to the grid, in words.
std::string left_to_grid(const std::string& variant, const Chain& chain) {
  const auto search = StrategyRegistry::instance().make(variant);
  search->build(chain);
  const Plan plan = search->plan();
  return std::ranges::find(plan, "grid of spheres", &Decision::step)->reason;
}

/// Of each step of a search by capsules it is said whether any block took it, of how many.
TEST(Cells, SayHowManyBlocksAreTangledAndCrowded) {
  std::vector<Sphere> crowd, row;
  for (std::uint32_t k = 0; k < 40; ++k) {
    add_rod(crowd, 0, 0, 0.01f * static_cast<float>(k));
    add_rod(row, 0, 100.0f * static_cast<float>(k), 0);
  }
  const Chain crowded = each_block_a_strand(crowd), apart = each_block_a_strand(row);
  using Told = std::pair<bool, std::string>;
  const auto told = [](const Variant& search, const char* step) {
    const Plan plan = search.plan();
    const auto found = std::ranges::find(plan, step, &Decision::step);
    return Told(found->left_out, found->reason);
  };
  const std::string tangled = " of 40 blocks of 32 spheres are tangled",
                    left = " of 40 blocks of 32 spheres are crowded";
  const auto& registry = StrategyRegistry::instance();
  const auto cells = registry.make("DeviceCapsules@host"),
             all = registry.make("DeviceHybrid@host(least=2000)");
  for (int k = 0; k < 2; ++k) {  // the one after the other, and again
    cells->build(crowded);
    EXPECT_EQ(told(*cells, "capsules in cells"), Told(false, "40" + tangled));
    EXPECT_EQ(told(*cells, "grid of spheres"), Told(false, "40" + left));
    cells->build(apart);
    EXPECT_EQ(told(*cells, "capsules in cells"), Told(false, "40" + tangled));
    EXPECT_EQ(told(*cells, "grid of spheres"), Told(true, "0" + left));
  }
  all->build(apart);  // too few for capsules
  EXPECT_EQ(told(*all, "capsules in cells"), Told(true, "0" + tangled));
  EXPECT_EQ(told(*all, "grid of spheres"), Told(false, "40" + left));
}

/// Beside rods that lie in a crowd, rods in a row, each of which touches one or two before it and as many
/// after it: then they are left to the search of the crowd, too, where each has four partners, or where the
/// crowd is more than about a sixth of all, unless nobody asks beforehand.
TEST(Cells, LeaveAllBlocksToTheSearchOfCrowdsWhereThatTakesLess) {
  constexpr std::uint32_t rods = 128;  // each is asked in the survey
  for (const std::uint32_t crowded : {rods / 2, 24u, 20u, 10u})
    for (const float apart : {1.9f, 0.95f}) {
      std::vector<Sphere> spheres;
      for (std::uint32_t k = 0; k < crowded; ++k) add_rod(spheres, 0, 0, 0.01f * static_cast<float>(k));
      for (std::uint32_t k = crowded; k < rods; ++k)
        add_rod(spheres, 0, 100 + apart * static_cast<float>(k), 0);
      const Chain chain = each_block_a_strand(spheres);
      const std::string all = std::to_string(rods) + " of ", some = std::to_string(crowded) + " of ";
      expect_exact(chain, some + "rods in a crowd, others in a row");
      const bool left = apart < 1 || crowded > 22;
      for (const std::string cells : {"0", "4194304"}) {
        const std::string name = "DeviceHybrid@host(least=0,cells=" + cells;
        EXPECT_TRUE(left_to_grid(name + ",survey=128)", chain).starts_with(left ? all : some))
            << cells << ", " << crowded;
        EXPECT_TRUE(left_to_grid(name + ",survey=0)", chain).starts_with(some)) << cells << ", " << crowded;
      }
    }
}

/// Where the tree says little of what is near, blocks are looked for in cells, if these are there, and few
/// are left to the grid. (What the survey counts of such blocks is BlockSurvey's own test.)
TEST(Cells, LeaveFewToTheSearchOfCrowdsWhereTheTreeSaysLittle) {
  constexpr std::uint32_t rods = 8 * (BlockSurvey::room + 40);
  const Chain chain = each_block_a_strand(scattered_rods(rods, 900));
  EXPECT_TRUE(
      left_to_grid("DeviceHybrid@host(cells=4194304)", chain).starts_with(std::to_string(rods) + " of "));
  const std::string said = left_to_grid("DeviceHybrid@host", chain);
  EXPECT_LT(std::stoul(said), rods / 100) << said;
  expect_exact(chain, "rods scattered in a cube");
}

/// A horn that grows by so much that squares of the thin end's lengths are none beside the thick one's: each
/// block meets the next one alone, at either end.
TEST(Cells, LeaveNoneOfAHornToTheSearchOfCrowds) {
  for (const char* decades : {"6", "20", "30"}) {
    const Chain chain = open_input(std::string("mixed_radii:n=20000,decades=") + decades).animation->frame(0);
    EXPECT_TRUE(left_to_grid("DeviceHybrid@host", chain).starts_with("0 of ")) << decades;
    expect_exact(chain, std::string("a horn of so many decades: ") + decades);
  }
}

}  // namespace
}  // namespace catena::properties

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/buckets.h"
#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/cells/find_partners.h"
#include "catena/core/cells/sphere_cells.h"
#include "catena/properties/testing/answer_of.h"
#include "catena/properties/testing/rods.h"

// Searches by hashed cells at the limits of their cells, partners and buckets, and one past them.
namespace catena::properties {
namespace {

TEST(Cells, LookAtNoMoreCapsulesThanAreDense) {
  constexpr std::uint32_t dense = CapsuleBlocks::dense;
  for (const std::uint32_t rods : {1u, 2u, 9u, dense - 1, dense, dense + 1, 3 * dense})
    for (const float apart : {1.9f, 2.1f, 0.15f}) {
      std::vector<Sphere> spheres;
      for (std::uint32_t k = 0; k < rods; ++k) add_rod(spheres, 0, 0, apart * static_cast<float>(k));
      expect_exact(each_block_a_strand(spheres), std::to_string(rods) + " rods side by side",
                   rods > 1 && apart < 2);
    }
}

/// Nodes each of which may meet all: as many as one may, itself too, and one more, and two; and as many as
/// one may go on with, where tangled blocks are left to the grid, and one more.
TEST(Cells, FindWhatNodesAtTheirLimitMeet) {
  constexpr std::uint32_t near = PartnerSearch::most_near, most = PartnerSearch::room / 2;
  for (const std::uint32_t nodes : {near - 1, near, near + 1, near + 2, most, most + 1})
    expect_exact(each_block_a_strand(scattered_rods(BlockNodes::children * nodes, nodes < most ? 120 : 240)),
                 std::to_string(nodes) + " nodes that meet one another");
}

/// Pairs of blocks, in another order, so that what follows one another lies apart: their nodes meet all
/// others.
std::vector<Sphere> scattered(const std::vector<Sphere>& pairs) {
  constexpr std::uint32_t pair = 2 * block, step = 37;
  const auto count = static_cast<std::uint32_t>(pairs.size()) / pair;
  EXPECT_NE(count % step, 0u);
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto from = pairs.begin() + k * step % count * pair;
    spheres.insert(spheres.end(), from, from + pair);
  }
  return spheres;
}

/// Capsules that reach nearly half a cell, of 64, touch with their tips what lies as far away as may be: the
/// first of two, which is to find the second in the cell before its own, or after it.
TEST(Cells, FindCapsulesAsLongAsACellIsWide) {
  constexpr float cell = 64, size = 1.235f, reach = size * (1.6f * 15.5f + 1), from_border = 0.2f,
                  deep = 0.1f;
  static_assert(2 * reach < cell);
  std::vector<Sphere> pairs;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      for (const float side : {-1.0f, 1.0f}) {
        const float border = 4 * cell * static_cast<float>(x), at_y = 4 * cell * static_cast<float>(y) + 32,
                    at_z = 2 * cell * side + 32;
        add_rod(pairs, border + side * (reach - from_border - deep + size), at_y + 0.8f * size, at_z, true,
                size);
        add_rod(pairs, border - side * from_border, at_y, at_z, false, size);
      }
  expect_exact(each_block_a_strand(scattered(pairs)), "rods that touch others with their tips");
}

/// Of two blocks that touch one is in the last bucket of a chunk, the other in the first of the next.
TEST(Cells, FindWhatLiesBehindTheEndOfAChunk) {
  constexpr float cell = 64;
  constexpr std::uint32_t crossings = 200;
  constexpr std::uint32_t level =
      18;  // of cells of 2^14, as which 64 are stored where the chain ends below 4096
  std::vector<Sphere> pairs;
  const CellTable table = CellTable::of(4 * (400 + 2 * crossings));
  std::uint32_t crossing = 0;
  for (int x = 20; x < 60; ++x)
    for (int y = -40; y < 40 && crossing < crossings; ++y)
      for (int z = -40; z < 40 && crossing < crossings; ++z)
        if (table.bucket(x, y, z, level) % Buckets::chunk == Buckets::chunk - 1) {
          const float at_x = cell * static_cast<float>(x + 1), at_y = cell * (static_cast<float>(y) + 0.5f),
                      at_z = cell * (static_cast<float>(z) + 0.5f);
          add_rod(pairs, at_x - 0.7f, at_y, at_z, true);
          add_rod(pairs, at_x + 0.7f, at_y + 3, at_z, true);
          ++crossing;
        }
  std::vector<Sphere> spheres = scattered_rods(400, 150);
  const std::vector<Sphere> apart = scattered(pairs);
  spheres.insert(spheres.end(), apart.begin(), apart.end());
  EXPECT_EQ(crossing, crossings);
  const float end = each_block_a_strand(spheres).view().extent.greatest_coordinate;
  EXPECT_TRUE(2048 <= end && end < 4096) << end;
  EXPECT_EQ(CapsuleBlocks::level_of(26 * 0x1p8f), level);
  expect_exact(each_block_a_strand(spheres), "rods beside one another, in two chunks");
}

/// The turns of a coil touch one another, each of five blocks or so; two blocks of it still go on in order.
TEST(Cells, FindWhatTouchesInANodeWhoseBlocksGoOnInOrder) {
  for (const float turn : {140.0f, 160.0f, 190.0f, 250.0f}) {
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < 40 * block; ++k) {
      const float at = static_cast<float>(k) / turn, angle = 6.2831853f * at,
                  radius = 1.6f * turn / 6.2831853f;
      spheres.push_back({radius * std::cos(angle), radius * std::sin(angle), 1.9f * at, 1});
    }
    expect_exact(Chain(spheres), "a coil of " + std::to_string(turn) + " spheres a turn");
  }
}

/// A straight strand through scattered rods: it is not tangled, and they are.
TEST(Cells, FindWhatTangledBlocksAndOthersShare) {
  std::vector<Sphere> spheres = scattered_rods(600, 200);
  for (std::uint32_t k = 0; k < 200 * block; ++k)
    spheres.push_back({1.6f * static_cast<float>(k) - 2500, 100, 100, 1});
  for (std::uint32_t k = 0; k < 77; ++k) spheres.push_back({60, 1.6f * static_cast<float>(k), 130, 1});
  expect_exact(Chain(spheres), "a rod that goes on through scattered rods");
}

/// Rods of many sizes, scattered: blocks look into all coarser levels of cells, but where there are too many
/// of these all are left to the search of spheres.
TEST(Cells, FindWhatBlocksOfManyLevelsMeet) {
  for (const std::uint32_t levels : {2u, CapsuleBlocks::most_levels, CapsuleBlocks::most_levels + 1, 6u}) {
    std::vector<Sphere> spheres;
    std::uint32_t state = 54321;
    const auto at = [&] {
      return 300 * static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f;
    };
    for (std::uint32_t k = 0; k < 500; ++k) {
      const float x = at(), y = at(), z = at();
      add_rod(spheres, x, y, z, k % 2 == 0, std::exp2(static_cast<float>(k % levels)));
    }
    expect_exact(each_block_a_strand(spheres), "rods of " + std::to_string(levels) + " sizes");
  }
}

TEST(Cells, HaveATreeOfAnySize) {
  for (const std::uint32_t blocks : {1u, 8u, 9u, 8192u, 8193u, 65537u, (1u << 26) - 1, 1u << 26}) {
    for (const std::uint32_t at_top : {BlockNodes::most_at_top, BlockNodes::children}) {
      const BlockNodes nodes = BlockNodes::over(blocks, at_top);
      ASSERT_LT(nodes.top, BlockNodes::most_levels);
      EXPECT_GE(nodes.top, 2u);
      EXPECT_LE(nodes.count[nodes.top], at_top);
      for (std::uint32_t level = 1; level <= nodes.top; ++level)
        EXPECT_EQ(nodes.count[level], (nodes.count[level - 1] + 7) / 8) << blocks;
    }
  }
}

/// Strands side by side, each sphere of which touches the one beside it, in a tree of five levels: each block
/// meets what lies at the far end of the chain, and between them much that it does not meet.
TEST(Cells, FindWhatLiesFarDownADeepTree) {
  constexpr std::uint32_t each = 9001 * block + 7, strands = 3;
  std::vector<Sphere> spheres;
  for (std::uint32_t s = 0; s < strands; ++s)
    for (std::uint32_t k = 0; k < each; ++k)
      spheres.push_back({1.5f * static_cast<float>(k), 1.875f * static_cast<float>(s), 0, 1});
  const Chain chain(std::move(spheres), Strands{{0, each, 2 * each, 3 * each}, {}});
  EXPECT_EQ(BlockNodes::over(CapsuleBlocks::blocks_of(chain.size()), BlockNodes::children).top, 4u);
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < (strands - 1) * each; ++i) expected.push_back({i, i + each});
  EXPECT_TRUE(answer_of("DeviceTree@host", chain).pairs == expected);
}

TEST(Cells, FindAllPartnersOfABlock) {
  for (std::uint32_t rods = 1; rods <= CapsuleBlocks::most_partners + 4; ++rods) {
    std::vector<Sphere> spheres;
    add_rod(spheres, 0, 0, 0);
    for (std::uint32_t k = 0; k < rods;
         ++k)  // across the first; 4 apart, so that they do not meet each other
      add_rod(spheres, 4.0f * static_cast<float>(k) - 22, 0, 1.5f, true);
    expect_exact(each_block_a_strand(spheres), std::to_string(rods) + " rods across");
  }
}

TEST(Cells, FindAllFinerPartnersOfABlock) {
  for (const std::uint32_t rods : {1u, 5u, CapsuleBlocks::most_met - 1, CapsuleBlocks::most_met,
                                   CapsuleBlocks::most_met + 1, CapsuleBlocks::most_met + 9}) {
    std::vector<Sphere> spheres;
    add_rod(spheres, 0, 0, 0, false, 64);
    for (std::uint32_t k = 0; k < rods; ++k)
      add_rod(spheres, 70.0f * static_cast<float>(k) - 1500, 20, 10, true);
    expect_exact(each_block_a_strand(spheres), std::to_string(rods) + " small rods in a large one");
  }
}

TEST(Cells, FindAdjacentSpheresThatAreNoNeighbours) {
  std::vector<Sphere> spheres;
  for (int k = 0; k < 6; ++k) add_rod(spheres, 51.2f * static_cast<float>(k), 0, 0);
  expect_exact(Chain(spheres, {}, Exclusion::arc(0.5)), "a rod, no two of which are neighbours");
  const auto n = static_cast<std::uint32_t>(spheres.size());
  expect_exact(Chain(spheres, Strands{{0, 70, 128, n}, {}}), "a rod cut in three");
}

/// The table for as many crowded spheres as there can be has no more buckets than memory was taken for.
TEST(Cells, CountNoMoreCrowdedSpheresThanThereAre) {
  const SphereCells cells = SphereCells::of({1, 1, 1e9, 1e6f});
  for (const std::uint32_t n :
       {1u, 32u, 4096u, 262144u, (1u << 20) - 5, 1u << 20, 1u << 24, (1u << 31) - 1}) {
    ChainView chain{};
    chain.size = n;
    CapsuleBlocks::State state{};
    CapsuleBlocks blocks = CapsuleBlocks::of(chain, 8, 1, 0, 0, 0);
    blocks.state = &state;
    for (std::uint32_t b = 0; b < blocks.blocks; b += blocks.sample) ++state.crowded;
    EXPECT_EQ(&cells.table_for(blocks.crowded_spheres()), &cells.table_for(n)) << n;
  }
}

/// Nor do fewer spheres need more buckets than more, whatever box the table is laid out for.
TEST(Cells, NeedNoMoreBucketsForFewerSpheres) {
  for (double cells = 1; cells < 420; cells += 0.5) {
    constexpr float radius = 0.5f;  // a cell is a little more than 1 wide
    const SphereCells of = SphereCells::of({radius, radius, 3 * cells, 1e3f});
    for (std::uint32_t k = 1; k < SphereCells::tables; ++k)
      EXPECT_LE(of.table[k - 1].buckets, of.table[k].buckets) << cells << " cells, table " << k;
  }
}

/// Thicker than it is finely sampled: a window certifies what no neighbours do.
TEST(Cells, GoOnInOrderBeyondAWindow) {
  for (const std::uint32_t window : {1u, 2u, 3u, 30u, 31u, 32u, 40u})
    for (const std::uint32_t beyond : {0u, 1u}) {
      std::vector<Sphere> spheres;
      const float step = 2.0f / static_cast<float>(window + beyond) - 0.001f;
      for (std::uint32_t k = 0; k < 5 * block + 3; ++k)
        spheres.push_back({step * static_cast<float>(k), 0, 0, 1});
      expect_exact(Chain(spheres, {}, Exclusion::index(window)),
                   "a rod in a window of " + std::to_string(window), beyond == 1);
    }
}

/// Every third step leads back, farther than a window of two sees.
TEST(Cells, TellAZigzagInAWindowFromARod) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < 6 * block; ++k) {
    const float ahead = k % 3 == 0 ? 0.0f : k % 3 == 1 ? 1.0f : 3.0f;
    spheres.push_back({2.1f * static_cast<float>(k / 3) + ahead, 0, 0, 1});
  }
  expect_exact(Chain(spheres, {}, Exclusion::index(2)), "a zigzag in a window");
}

/// Small spheres by the hundred in the cell of a large one are sorted by octaves.
TEST(Cells, PartByOctavesWhatCrowdsOneLevel) {
  for (const std::uint32_t small : {30u, 300u, 3000u}) {
    std::vector<Sphere> spheres{{0, 0, 0, 1}, {50, 0, 0, 1}};
    for (std::uint32_t k = 0; k < small; ++k)
      spheres.push_back(
          {0.9f + 0.002f * static_cast<float>(k % 100), 0.01f * static_cast<float>(k / 100), 0, 0.0015f});
    Strands strands;
    for (std::uint32_t at = 0; at <= spheres.size(); ++at) strands.first.push_back(at);
    expect_exact(Chain(spheres, strands), std::to_string(small) + " small spheres beside a large one");
  }
}

/// A crowd of small spheres on one side of a plane through the origin, which one of them touches, and a large
/// one touches from the other.
TEST(Cells, LookIntoOctavesWhoseBoxesTouch) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      std::vector<Sphere> spheres;
      const auto add = [&](float along, float radius) {
        Sphere s{0, 0, 0, radius};
        (axis == 0 ? s.x : axis == 1 ? s.y : s.z) = side * along;
        spheres.push_back(s);
      };
      add(-1, 1);
      for (int k = 0; k < 300; ++k) add(0x1p-7f + 0x1p-10f * static_cast<float>(k), 0x1p-7f);
      add(-9, 1);
      expect_exact(Chain(spheres, Strands{{0, 1, 301, 302}, {}}), "a crowd that touches a large sphere");
    }
}

/// In every second block each other step leads back, so that a sphere ends before the next but one begins,
/// and meets the third.
TEST(Cells, TellAZigzagFromARod) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < 6 * block; ++k) {
    const bool back = k % 2 == 1 && k / block % 2 == 0;
    spheres.push_back({2.1f * static_cast<float>(k / 2) + (back         ? -1.0f
                                                           : k % 2 == 1 ? 1.05f
                                                                        : 0.0f),
                       0, 0, 1});
  }
  expect_exact(Chain(spheres), "a zigzag");
}

/// Cells that lie apart in space, and all in one bucket.
TEST(Cells, LoseNothingWhereAllCollideInTheHash) {
  constexpr std::uint32_t groups = 300;
  const std::uint32_t n = 3 * groups;
  const SphereCells cells = SphereCells::of({1, 1, 1e9, 1e6f});
  const CellTable& table = cells.table_for(n);
  int dx = 0, dy = 0, dz = 0;
  for (int y = 1; y < 300 && dx == 0; ++y)
    for (int z = 1; z < 300 && dx == 0; ++z)
      for (int x = 3; x < 60 && dx == 0; ++x)
        if (table.bucket(x, y, z, 0) == table.bucket(0, 0, 0, 0)) dx = x, dy = y, dz = z;
  ASSERT_NE(dx, 0);
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < groups; ++k) {
    const auto at = [&](int step) {
      return static_cast<float>((step * double(k) + 0.5) / cells.cells_per_unit);
    };
    EXPECT_EQ(table.bucket(cells.cell({at(dx), at(dy), at(dz), 1}, 0), 0), table.bucket(0, 0, 0, 0));
    for (int s = 0; s < 3; ++s)
      spheres.push_back({at(dx) + 0.25f * static_cast<float>(s), at(dy), at(dz), 1});
  }
  expect_exact(Chain(spheres, {}, {}), "one bucket for all");
}

}  // namespace
}  // namespace catena::properties

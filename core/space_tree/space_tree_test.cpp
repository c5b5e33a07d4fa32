#include "catena/core/space_tree/space_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ranges>
#include <string>
#include <vector>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/chain/chain.h"
#include "catena/core/space_tree/space_kernels.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/family.h"

namespace catena {
namespace {

struct Built {
  BlockTree tree;
  Crowding crowding;
  SpaceTree space;
  Built() = default;
  explicit Built(const ChainView& chain) { build(chain, SpaceSort::anew); }
  void build(const ChainView& chain, SpaceSort sort) {
    const Team alone;
    SpaceQueue queue;
    build_block_tree(chain, tree, alone);
    find_crowds(chain, tree, 0, crowding, alone);
    if (crowding.crowded_nodes() > 0)
      build_space_tree(chain, tree, crowding, space, {false, 1e6, 0}, {&queue, 1}, Team(), sort);
  }
};

float field(const SpaceTree& space, std::size_t level, std::uint32_t k, std::uint32_t f) {
  return space.boxes_of(level, k / SpaceTree::group)[f * SpaceTree::group + k % SpaceTree::group];
}

/// In 64 bits of precision; the slack that a box has is 2^20 times as much.
bool holds(const SpaceTree& space, std::uint32_t entry, const Sphere& s, float scale) {
  const float at[3] = {s.x, s.y, s.z};
  for (std::uint32_t d = 0; d < 3; ++d) {
    const long double from = static_cast<long double>(at[d]) * scale - space.origin[d],
                      radius = static_cast<long double>(s.radius) * scale;
    if (from - radius < field(space, 0, entry, d) || from + radius > field(space, 0, entry, 3 + d))
      return false;
  }
  return true;
}

void expect_sound(const Chain& chain, const Built& built, const std::string& what, std::uint32_t& parts) {
  const SpaceTree& space = built.space;
  if (space.entries == 0) return;
  std::map<std::uint32_t, std::vector<std::uint32_t>> spheres_of;  // by block
  for (std::uint32_t k = 0; k < space.entries; ++k) {
    const std::uint32_t b = space.block[k];
    parts += b >= built.tree.blocks;
    for (std::uint32_t j = 0; j < BlockTree::block; ++j) {
      const std::uint32_t i = built.tree.index(b, j);
      if (i == BlockTree::no_sphere) continue;
      spheres_of[space.whole[k]].push_back(i);
      EXPECT_TRUE(holds(space, k, chain.spheres()[i], built.tree.scale)) << what << ": sphere " << i;
    }
  }
  for (auto& [b, spheres] : spheres_of) {
    std::ranges::sort(spheres);
    std::vector<std::uint32_t> own;
    for (std::uint32_t j = 0; j < BlockTree::block; ++j)
      if (const std::uint32_t i = built.tree.index(b, j); i != BlockTree::no_sphere) own.push_back(i);
    EXPECT_EQ(spheres, own) << what << ": block " << b << " is not there as a whole, or in parts that differ";
  }
  std::uint32_t crowded = 0;
  for (std::uint32_t node = 0; node < built.crowding.nodes(); ++node)
    if (built.crowding.crowded(node)) crowded += built.tree.blocks_of(node);
  EXPECT_EQ(spheres_of.size(), crowded) << what;
  for (std::size_t l = 1; l < space.boxes.size(); ++l)
    for (std::uint32_t k = 0; k < space.boxes[l - 1].size() / SpaceTree::box_fields; ++k)
      for (std::uint32_t d = 0; d < 3; ++d) {
        EXPECT_LE(field(space, l, k / SpaceTree::group, d), field(space, l - 1, k, d)) << what;
        EXPECT_GE(field(space, l, k / SpaceTree::group, 3 + d), field(space, l - 1, k, 3 + d)) << what;
      }
  for (std::size_t l = 0; l < space.boxes.size(); ++l)
    EXPECT_EQ(space.boxes[l].size() == SpaceTree::group * SpaceTree::box_fields, l + 1 == space.boxes.size())
        << what << ": a single group is the top";
}
void expect_sound(const Chain& chain, const std::string& what, std::uint32_t& parts) {
  expect_sound(chain, Built(chain.view()), what, parts);
}

TEST(SpaceTree, HoldsEachSphereOfACrowdOnceAndInItsBoxes) {
  std::uint32_t parts = 0;
  std::uint64_t seed = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (const std::uint32_t size : {500u, 3000u}) {
      properties::Dice dice(++seed);
      expect_sound(properties::generate(family, dice, size), family.name, parts);
    }
  // Strands of a rope that are told as one chain: it jumps from each to the next.
  std::vector<Sphere> hair;
  for (std::uint32_t k = 0; k < 60; ++k)
    for (std::uint32_t i = 0; i < 37; ++i)
      hair.push_back(
          {static_cast<float>(i), static_cast<float>(k % 8) * 1.5f, static_cast<float>(k / 8), 0.6f});
  expect_sound(Chain(hair), "hair", parts);
  EXPECT_GT(parts, 50u) << "no block was cut";
}

/// Frames of which one lies as the last did, and one elsewhere, and one that is shorter: an order is kept of
/// the first alone, and whatever is kept holds what is there now.
TEST(SpaceTree, IsSoundWhateverOrderItKept) {
  const auto wound = [](std::uint32_t n) {
    properties::Dice dice(1);
    std::vector<Sphere> spheres;
    float at[3] = {0, 0, 0}, way[3] = {1, 0, 0};
    for (std::uint32_t i = 0; i < n; ++i) {
      spheres.push_back({at[0], at[1], at[2], 1});
      for (int d = 0; d < 3; ++d) at[d] += way[d] += 0.2f * dice.symmetric() - 0.02f * at[d] - 0.05f * way[d];
    }
    return spheres;
  };
  std::vector<Sphere> spheres = wound(5000);
  Built built;
  std::uint32_t parts = 0;
  const auto frames_kept = [&](const Chain& chain) {
    built.build(chain.view(), SpaceSort::where_needed);
    EXPECT_GT(built.space.entries, 100u);
    expect_sound(chain, built, std::to_string(chain.size()), parts);
    return built.space.kept.frames();
  };
  EXPECT_EQ(frames_kept(Chain(spheres)), 0u);
  for (Sphere& s : spheres) s.x += 0.1f * s.y;
  EXPECT_EQ(frames_kept(Chain(spheres)), 1u);
  std::ranges::swap_ranges(spheres | std::views::take(1024), spheres | std::views::drop(3000));
  EXPECT_EQ(frames_kept(Chain(spheres)), 0u);
  EXPECT_EQ(frames_kept(Chain(wound(1500))), 0u);
}

TEST(SpaceOrder, SortsEveryBoxOnceGreatOnesFirst) {
  properties::Dice dice(5);
  std::vector<float> boxes;
  constexpr std::uint32_t n = 3000;
  for (std::uint32_t k = 0; k < n; ++k) {
    const float size = dice.one_in(10) ? 50.0f : 1.0f;
    float low[3];
    for (float& x : low) boxes.push_back(x = 100 * dice.symmetric());
    for (const float x : low) boxes.push_back(x + size);
  }
  SpaceOrder order;
  order.sort({boxes.data(), 6, n}, Team());
  std::vector<std::uint32_t> all;
  double steps = 0;
  bool small = false;
  for (std::uint32_t k = 0; k < n; ++k) {
    all.push_back(order[k]);
    const float* const box = boxes.data() + 6 * all.back();
    const bool is_small = box[3] - box[0] < 25;
    EXPECT_TRUE(is_small || !small) << "a great box after a small one";
    small = is_small;
    if (k > 0)
      for (int d = 0; d < 3; ++d) steps += std::abs(box[d] - boxes[6 * all[k - 1] + d]);
  }
  std::ranges::sort(all);
  for (std::uint32_t k = 0; k < n; ++k) ASSERT_EQ(all[k], k);
  // At random two are 200 apart, on average.
  EXPECT_LT(steps / n, 60) << "what follows one another is not near";
}

TEST(SpaceOrder, IsTheSameForAnyTeam) {
  properties::Dice dice(6);
  std::vector<float> boxes;
  constexpr std::uint32_t n = 70'000;  // a third of them in one cube, and some at one place
  for (std::uint32_t k = 0; k < n; ++k) {
    const float wide = dice.one_in(3) ? 0.01f : dice.one_in(5) ? 0.0f : 100.0f;
    float low[3];
    for (float& x : low) boxes.push_back(x = wide * dice.symmetric());
    for (const float x : low) boxes.push_back(x + 1);
  }
  SpaceOrder one, several;
  one.sort({boxes.data(), 6, n}, Team());
  several.sort({boxes.data(), 6, n}, Team(Parameters("test", {Team::threads_parameter()}, "threads=3")));
  for (std::uint32_t k = 0; k < n; ++k) ASSERT_EQ(one[k], several[k]) << k;
}

}  // namespace
}  // namespace catena

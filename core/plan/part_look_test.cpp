#include "catena/core/plan/part_look.h"

#include <gtest/gtest.h>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/input/input.h"

namespace catena {
namespace {

std::optional<Pair> look(const Chain& chain, const SphereRange& queries = {}) {
  PartLook part;
  return part.look(chain.view(), queries);
}

TEST(PartLook, GivesAPairThatCollides) {
  const Chain chain = open_input("grazing:n=300000,margin=0").animation->frame(0);
  const auto pair = look(chain);
  ASSERT_TRUE(pair);
  EXPECT_LT(pair->i, pair->j);
  EXPECT_FALSE(chain.neighbours(pair->i, pair->j));
  EXPECT_TRUE(Robust::overlap(chain[pair->i], chain[pair->j]));
  EXPECT_FALSE(look(chain, {0, 1000})) << "none of which one is asked for";
}

/// Neighbours are those of the chain: here every sphere overlaps the next ones, and nothing else.
TEST(PartLook, TakesNoNeighbours) {
  std::vector<Sphere> row;
  for (std::uint32_t i = 0; i < PartLook::least; ++i) row.push_back({static_cast<float>(i), 0, 0, 0.75F});
  EXPECT_FALSE(look(Chain(row)));
  EXPECT_FALSE(look(Chain(row, {}, Exclusion::arc(1.6))));
  for (Sphere& s : row) s.radius = 1;
  EXPECT_TRUE(look(Chain(row)));
  EXPECT_FALSE(look(Chain(row, {}, Exclusion::index(2))));
  Exclusion exclusion = Exclusion::index(1);
  for (std::uint32_t i = 0; i + 2 < row.size(); ++i) exclusion.extra_pairs.push_back({i, i + 2});
  EXPECT_FALSE(look(Chain(row, {}, exclusion)));
}

TEST(PartLook, IsTheSameWhateverItLookedAtBefore) {
  std::vector<Sphere> row;
  for (std::uint32_t i = 0; i < PartLook::least + 512; ++i)
    row.push_back({static_cast<float>(i / 2), i % 2 ? 2.0F : 0, 0, 0.5F});
  const std::vector<Sphere> shorter(row.begin(), row.end() - 512);
  PartLook used;
  for (const auto& spheres : {row, shorter})
    for (const std::uint32_t window : {3u, 1u, 2u, 4u, 1u}) {
      const Chain chain(spheres, {}, Exclusion::index(window));
      const auto pair = used.look(chain.view(), {});
      EXPECT_EQ(pair, look(chain)) << window;
      EXPECT_EQ(pair.has_value(), window < 2) << window;  // each touches the next but one
    }
}

/// Too many pairs to be kept, none of which is one in what is asked for.
TEST(PartLook, GivesNothingOfACrowd) {
  EXPECT_FALSE(look(Chain(std::vector<Sphere>(PartLook::least, {1, 2, 3, 1})), {0, 1}));
}

TEST(PartLook, LeavesShortChainsAlone) {
  EXPECT_FALSE(look(open_input("grazing:n=5000,margin=0").animation->frame(0)));
}

}  // namespace
}  // namespace catena

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/error.h"
#include "catena/core/executor/team.h"
#include "catena/core/scenes/scene.h"

namespace catena {
namespace {

/// Numbers so near to 0 that products with them are subnormal, which takes most machines a hundred times as
/// long: whatever lies along an axis has zeros elsewhere.
std::size_t nearly_zero(std::span<const float> fields) {
  return static_cast<std::size_t>(
      std::ranges::count_if(fields, [](float f) { return f != 0 && std::abs(f) < 0x1p-100f; }));
}

TEST(BuildTree, MakesNoNumberThatIsNextToNothing) {
  std::size_t zeros = 0;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes())
    for (const char* align : {"", ",align=axes", ",align=general"}) {
      const std::string spec = scene.name + ":n=30000" + align;
      std::unique_ptr<Animation> animation;
      try {
        animation = SceneRegistry::instance().open(spec);
      } catch (const InputError&) {
        continue;  // has no such parameter
      }
      const Chain chain = animation->frame(0);
      BlockTree tree;
      build_block_tree(chain.view(), tree, Team());
      for (const BlockTree::Level& level : tree.level) {
        constexpr std::uint32_t group = BlockTree::group, axes = 3 * group, sides = 12 * group;
        for (std::uint32_t k = 0; k < level.count; k += group) {
          const std::span<const float> fields(level.at(k) + axes, sides - axes);
          EXPECT_EQ(nearly_zero(fields), 0u) << spec;
          zeros += static_cast<std::size_t>(std::ranges::count(fields, 0.0f));
        }
      }
    }
  EXPECT_GT(zeros, 1000u) << "nothing lies along an axis";
}

/// Spheres along an axis, farther and farther apart: their mean is not the middle. Whether a node is alone on
/// its level or not, its box ends near where they do, to either side.
TEST(BuildTree, PutsTheMiddleOfABoxIntoTheMiddle) {
  constexpr std::uint32_t group = BlockTree::group, centre = 0, axis = 3 * group, half = 12 * group;
  for (const std::uint32_t n : {100u, 1500u, 40'000u})
    for (int along = 0; along < 3; ++along) {
      std::vector<Sphere> spheres;
      for (std::uint32_t k = 0; k < n; ++k) {
        float at[3] = {};
        at[along] = std::exp(3.0f * static_cast<float>(k) / static_cast<float>(n));
        spheres.push_back({at[0], at[1], at[2], 1e-4f});
      }
      const Chain chain(spheres);
      BlockTree tree;
      build_block_tree(chain.view(), tree, Team());
      const BlockTree::Level& top = tree.level.back();
      ASSERT_EQ(top.count, 1u);
      const auto field = [&](std::uint32_t f) { return top.at(0)[f] / tree.scale; };
      const double middle = field(centre + along * group);
      double reach = 0;
      for (std::uint32_t d = 0; d < 3; ++d) {
        const double along_it = top.at(0)[axis + (3 * d + along) * group];
        if (std::abs(along_it) > 0.9) reach = field(half + d * group);
      }
      const double first = std::exp(0.0), last = std::exp(3.0);
      EXPECT_NEAR(middle, (first + last) / 2, 0.01 * (last - first)) << n << ", " << along;
      EXPECT_NEAR(reach, (last - first) / 2, 0.01 * (last - first)) << n << ", " << along;
    }
}

}  // namespace
}  // namespace catena

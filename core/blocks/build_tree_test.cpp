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

}  // namespace
}  // namespace catena

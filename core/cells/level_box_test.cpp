#include "catena/core/cells/level_box.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace catena {
namespace {

/// All that spheres may be along an axis: both zeros, either side of them, the least and the greatest.
std::vector<Box> boxes() {
  constexpr float most = std::numeric_limits<float>::max();
  std::vector<Box> boxes;
  for (const float at : {0.0f, -0.0f, 0x1p-149f, -0x1p-149f, 1.0f, -1.0f, 3.0f, most, -most})
    for (const float radius : {0.0f, 0x1p-149f, 1.0f, 2.0f, most})
      boxes.push_back(Box::around({at, -at, 1 - at, radius}));
  return boxes;
}

TEST(LevelBox, MeetsWhatTheBoxAroundItsSpheresMeets) {
  const std::vector<Box> all = boxes();
  std::size_t meets = 0;
  for (const Box& a : all)
    for (const Box& b : all) {
      LevelBox level{};
      level.join(LevelBox::Ends(a));
      level.join(LevelBox::Ends(b));
      Box both = a;
      both.join(b);
      for (const Box& other : all) {
        EXPECT_EQ(level.meets(LevelBox::Facing(other)), both.meets(other));
        meets += both.meets(other);
      }
    }
  EXPECT_GT(meets, 0u);
  EXPECT_LT(meets, all.size() * all.size() * all.size());
}

TEST(LevelBox, OfNoSpheresMeetsNothing) {
  const LevelBox none{};
  for (const Box& box : boxes()) EXPECT_FALSE(none.meets(LevelBox::Facing(box)));
}

}  // namespace
}  // namespace catena

// What the scene of the ropes promises beyond what every scene does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/test_pairs.h"

namespace catena {
namespace {

std::unique_ptr<Animation> open(const std::string& spec) { return SceneRegistry::instance().open(spec); }

bool same(const Chain& a, const Chain& b) { return std::ranges::equal(a.spheres(), b.spheres()); }

std::size_t contacts(const Chain& chain) {
  const auto touching = test::touching_pairs(chain.spheres());
  return static_cast<std::size_t>(
      std::ranges::count_if(touching, [&](const Pair& p) { return !chain.neighbours(p.i, p.j); }));
}

TEST(Rope, IsPulledIntoAKnotThatStays) {
  const auto rope = open("rope:n=80,rope=80,duration=60,frames=13");
  EXPECT_EQ(contacts(rope->frame(0)), 0u);
  for (const std::uint32_t f : {10u, 11u, 12u}) EXPECT_GE(contacts(rope->frame(f)), 5u) << f;
}

TEST(Rope, HasTheSameFramesInWhateverOrderAndFromWhateverExactVariant) {
  const std::string spec = "rope:n=80,rope=80,duration=30,frames=7";
  const auto forward = open(spec), backward = open(spec), other = open(spec + ",variant=CPU1");
  const Chain late = backward->frame(6);
  for (const std::uint32_t f : {0u, 3u, 6u}) {
    EXPECT_TRUE(same(forward->frame(f), backward->frame(f))) << f;
    EXPECT_TRUE(same(forward->frame(f), other->frame(f))) << f;
  }
  EXPECT_FALSE(same(late, backward->frame(5)));
  EXPECT_FALSE(same(late, open(spec + ",seed=2")->frame(6)));
  EXPECT_THROW(forward->frame(7), std::out_of_range);
}

TEST(Rope, RepeatsTwoRopesAndKeepsTheOthersApart) {
  const auto ropes = open("rope:n=430,rope=80,duration=60,frames=3,align=axes");
  const Chain chain = ropes->frame(2);
  ASSERT_EQ(chain.strand_count(), 6u) << "five of 80 and one of 30";
  const auto shape = [&](std::uint32_t i) { return double{chain[i].x} - chain[i / 80 * 80].x; };
  double between_twins = 0;
  for (std::uint32_t i = 0; i < 80; ++i) {
    EXPECT_NEAR(shape(i), shape(160 + i), 1e-4);
    between_twins = std::max(between_twins, std::abs(shape(i) - shape(80 + i)));
  }
  EXPECT_GT(between_twins, 1e-3);
  for (const Pair& p : test::touching_pairs(chain.spheres())) EXPECT_EQ(p.i / 80, p.j / 80);
}

TEST(Rope, SaysWhatIsWrong) {
  const auto refusal = [](const std::string& spec, std::uint32_t frame) -> std::string {
    try {
      open(spec)->frame(frame);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal("rope:variant=CPU7", 0).find("CPU1"), std::string::npos);
  EXPECT_NE(refusal("rope:step=0", 0).find("step=0"), std::string::npos);
  EXPECT_NE(refusal("rope:n=120,step=1e5,stiffness=1e9", 40).find("lower step"), std::string::npos);
}

}  // namespace
}  // namespace catena

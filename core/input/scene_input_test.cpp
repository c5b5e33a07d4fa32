#include "catena/core/input/scene_input.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/input/input.h"
#include "catena/core/input/test_refusal.h"

namespace catena {
namespace {

// Where an option is not heeded, nothing is made as if it had been.
TEST(OpenInput, RefusesOptionsOfFilesForScenes) {
  for (const ReadOptions& reading : {ReadOptions{.columns = {"x", "y", "z"}},
                                     {.atom = "CA"},
                                     {.array = "r"},
                                     {.topology = "a.top"},
                                     {.recentre = true}})
    EXPECT_REFUSAL(
        "rod:n=5: --columns, --atom, --array, --topology, --recentre and --origin are for files, not for "
        "scenes",
        "rod:n=5", {.reading = reading});
  EXPECT_REFUSAL("rod:n=5: there is no such file", "rod:n=5", {.reading = {.format = "xyz"}});
}

TEST(OpenInput, OpensScenes) {
  EXPECT_EQ(open_input("rod:n=7").animation->frame(0).size(), 7u);
  EXPECT_REFUSAL("no_such_scene", "no_such_scene");
  EXPECT_REFUSAL("no_such_scene", "no_such_scene:n=5,frame=1");
  EXPECT_REFUSAL("scene rod: n=1/2 must be", "rod:n=1/2");  // no file, though it has a slash
  EXPECT_REFUSAL("radii of its own", "rod", {.radius = 1.0f});
  EXPECT_REFUSAL("radii of its own", "rod", {.radius_half_spacing = true});
  EXPECT_REFUSAL("closed", "rod", {.closed = true});
}

TEST(OpenInput, TakesOneFrameOfAScene) {
  const Input all = open_input("path1:n=20");
  ASSERT_GT(all.animation->frames(), 2u);
  const Input one = open_input("path1:frame=2,n=20"), first = open_input("path1:n=20,frame=0");
  EXPECT_EQ(one.animation->frames(), 1u);
  EXPECT_EQ(one.animation->frame(0)[3], all.animation->frame(2)[3]);
  EXPECT_EQ(first.animation->frame(0)[3], all.animation->frame(0)[3]);
  const Chain second = all.animation->frame(2);
  const auto stretches = one.animation->in_stretches(0);
  ASSERT_TRUE(stretches);
  EXPECT_TRUE(std::ranges::equal(stretches->spheres(0, 20), second.spheres()));
  EXPECT_EQ(written_frame("path1:frame=2,n=20"), 2u);
  EXPECT_EQ(written_frame("a:frame=2.csv"), 0u) << "the name of a file";
  EXPECT_EQ(open_input("rod:frame=0").animation->frames(), 1u);
  EXPECT_REFUSAL("has the frames 0 to", "path1:n=20,frame=4000000000");
  EXPECT_REFUSAL("has the frames 0 to 0", "rod:n=5,frame=1");
  EXPECT_REFUSAL("frame is given twice", "path1:frame=1,frame=1");
  for (const char* bad :
       {"path1:frame=", "path1:frame=-1", "path1:frame=1.5", "path1:frame=99999999999999999999"})
    EXPECT_REFUSAL("must be a frame number", bad);
}

TEST(OpenInput, WindowsApplyToEveryFrameOfAScene) {
  const Input wide = open_input("path1:n=20", {.window = 3});
  EXPECT_TRUE(wide.animation->frame(1).neighbours(4, 7));
  EXPECT_FALSE(wide.animation->frame(1).neighbours(4, 8));
  EXPECT_EQ(wide.animation->frame(1)[5], open_input("path1:n=20").animation->frame(1)[5]);
  EXPECT_REFUSAL("exclude each other", "path1:n=20", {.window = 3, .arc_window = 1.6});
  const Input moving = open_input("path1:n=20"), round = open_input("path1:n=20", {.arc_window = 1.6});
  for (const std::uint32_t f : {0u, 1u, moving.animation->frames() - 1}) {
    const Chain plain = moving.animation->frame(f), windowed = round.animation->frame(f);
    EXPECT_TRUE(std::ranges::equal(windowed.spheres(), plain.spheres())) << f;
    EXPECT_EQ(windowed.view().exclusion.arc[19], round.animation->frame(0).view().exclusion.arc[19])
        << "neighbours are those of frame 0";
    const auto stretches = round.animation->in_stretches(f);
    ASSERT_TRUE(stretches);
    EXPECT_EQ(stretches->exclusion.rule, Exclusion::Rule::arc_window);
    EXPECT_EQ(stretches->exclusion.factor, 1.6);
  }
  const Input snake = open_input("path1:n=50"), windowed = open_input("path1:n=50", {.window = 2});
  for (std::uint32_t f = 1; f < snake.animation->frames(); ++f)
    EXPECT_EQ(windowed.animation->shift(f), snake.animation->shift(f)) << f;
  EXPECT_NE(snake.animation->shift(1), 0);
  const Input arc = open_input("path1:n=20,frame=1", {.arc_window = 1.6});
  EXPECT_EQ(arc.animation->frame(0).exclusion().rule, Exclusion::Rule::arc_window);
}

TEST(OpenInput, RefusesACommaWithNothingBesideIt) {
  for (const char* spec : {"rod:n=5,", "rod:,n=5", "rod:n=5,frame=0,", "rod:,frame=0", "rod:frame=0,,n=5"})
    EXPECT_REFUSAL("rod: a comma has no key=value on one side of it", spec);
  EXPECT_REFUSAL("no scene is named 'rods'", "rods:n=5,");
}

}  // namespace
}  // namespace catena

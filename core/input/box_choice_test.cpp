#include "catena/core/input/box_choice.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "catena/core/error.h"
#include "catena/core/input/test_refusal.h"
#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

const PeriodicBox of_file{{8, 8, 8}}, of_user{{5, 6, 7}};

InputOptions heeding(BoxFrom from) {
  InputOptions options;
  options.takes_box = true;
  options.box_from = from;
  options.box = of_user;
  options.radius = 0.5f;
  return options;
}

std::vector<PeriodicBox> boxes_of(const std::string& name, BoxFrom from) {
  return open_input(example(name).string(), heeding(from)).boxes;
}

TEST(BoxChoice, TakesWhatTheFileSaysIsPeriodicAndAsksForTheRest) {
  EXPECT_EQ(boxes_of("melt.dump", BoxFrom::told), std::vector<PeriodicBox>(2, of_file));
  EXPECT_EQ(boxes_of("melt.data", BoxFrom::told), std::vector<PeriodicBox>{});
  EXPECT_EQ(boxes_of("melt.data", BoxFrom::file), std::vector<PeriodicBox>{of_file});
  EXPECT_EQ(boxes_of("melt.data", BoxFrom::options), std::vector<PeriodicBox>{of_user});
  EXPECT_EQ(boxes_of("melt.dump", BoxFrom::none), std::vector<PeriodicBox>{});
  EXPECT_THROW(boxes_of("loop.obj", BoxFrom::file), InputError);
  // Walls on all sides: nothing repeats, and nobody need say so.
  const TestFile walls(
      "w.dump",
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ss fm\n0 9\n0 9\n0 9\n"
      "ITEM: ATOMS id mol x y z\n1 1 0 0 0\n");
  EXPECT_TRUE(open_input(walls.path().string(), {.radius = 1.0f, .takes_box = true}).boxes.empty());
  EXPECT_TRUE(open_input(walls.path().string(), {.radius = 1.0f}).boxes.empty());
  // In one frame walls, in the next none: no search is for both.
  const auto frame = [](const char* faces) {
    return std::string("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ") + faces +
           "\n0 9\n0 9\n0 9\nITEM: ATOMS id mol x y z\n1 1 0 0 0\n";
  };
  const TestFile some("s.dump", frame("ff ff ff") + frame("pp pp pp"));
  EXPECT_THROW(open_input(some.path().string(), {.radius = 1.0f, .takes_box = true}), InputError);
  const InputOptions scene{.box_from = BoxFrom::options, .box = of_user, .takes_box = true};
  EXPECT_EQ(open_input("path1:n=9", scene).boxes, std::vector<PeriodicBox>{of_user});
  EXPECT_THROW(open_input("path1:n=9", {.box_from = BoxFrom::file}), InputError);
}

TEST(BoxChoice, SaysWhatIsLeftOut) {
  const auto warning = [](const char* name, const InputOptions& options) {
    const Input input = open_input(example(name).string(), options);
    EXPECT_TRUE(input.boxes.empty());
    return input.warnings.empty() ? "" : input.warnings.back();
  };
  EXPECT_EQ(warning("melt.data", heeding(BoxFrom::told)),
            "the box of the file, 8 x 8 x 8, is left out; --box file says that space repeats it");
  EXPECT_EQ(warning("melt.data", {.radius = 0.5f}),
            "the box of the file, 8 x 8 x 8, is left out; --box none says that it is to be");
  EXPECT_EQ(warning("melt.dump", heeding(BoxFrom::none)), "");
}

// Where a box is not heeded, no answer without it is given for one with it.
TEST(BoxChoice, RefusesABoxThatWouldNotBeHeeded) {
  const std::string melt = example("melt.dump").string(), data = example("melt.data").string();
  const auto asks = [](BoxFrom from) {
    InputOptions options = heeding(from);
    options.takes_box = false;
    return options;
  };
  for (const auto& [spec, from] :
       {std::pair(melt, BoxFrom::told), {melt, BoxFrom::file}, {data, BoxFrom::file}})
    EXPECT_EQ(
        refusal(spec, asks(from)),
        spec +
            ": the box of the file, 8 x 8 x 8, repeats space, which this command does not know; --box none "
            "leaves it out, if it is an option here, else of what is written by catena export FILE "
            "NEW.chain --box none");
  for (const std::string& spec : {melt, data})
    EXPECT_TRUE(
        refusal(spec, asks(BoxFrom::options)).starts_with(spec + ": the box of --box, 5 x 6 x 7, repeats"));
  InputOptions scene = asks(BoxFrom::options);
  scene.radius.reset();
  EXPECT_TRUE(refusal("path1:n=9", scene).starts_with("path1:n=9: the box of --box, 5 x 6 x 7, repeats"));
  EXPECT_EQ(refusal(melt, asks(BoxFrom::none)), "");
}

// The first chain lies across two faces; its arc lengths are those of the whole chain.
TEST(BoxChoice, ArcLengthsAreThoseOfWholeTubes) {
  InputOptions options = heeding(BoxFrom::file);
  options.arc_window = 2.5;
  const Chain chain = open_input(example("melt.data").string(), options).animation->frame(0);
  EXPECT_EQ(chain[2].x, 0.5f);
  EXPECT_TRUE(chain.neighbours(1, 2));
  EXPECT_TRUE(chain.neighbours(0, 2));
  EXPECT_FALSE(chain.neighbours(0, 3));
  // A branch of the third atom, across another face.
  const TestFile branched("a.data",
                          "t\n\n6 atoms\n5 bonds\n\n0 8 xlo xhi\n0 8 ylo yhi\n0 8 zlo zhi\n\nAtoms # bond\n\n"
                          "1 1 1 6.5 0.5 4\n2 1 1 7.5 0.5 4\n3 1 1 0.5 0.5 4\n4 1 1 1.5 0.5 4\n"
                          "5 1 1 0.5 7.5 4\n6 1 1 0.5 6.5 4\n\n"
                          "Bonds\n\n1 1 1 2\n2 1 2 3\n3 1 3 4\n4 1 3 5\n5 1 5 6\n");
  const Chain tree = open_input(branched.path().string(), options).animation->frame(0);
  ASSERT_EQ(tree.strand_count(), 2u);
  EXPECT_EQ(tree[4].y, 7.5f);
  for (const Pair& near : {Pair{2, 4}, {1, 4}, {3, 4}, {2, 5}}) EXPECT_TRUE(tree.neighbours(near.i, near.j));
  for (const Pair& far : {Pair{0, 4}, {1, 5}, {3, 5}}) EXPECT_FALSE(tree.neighbours(far.i, far.j));
}

/// What is lost of a thinned tube between two spheres is measured across the faces of each frame's own box.
TEST(BoxChoice, ATubeIsThinnedInTheBoxOfEachFrame) {
  constexpr int n = 81;
  constexpr double step = 0.25;
  std::string frames;
  for (const double side : {10.0, 15.0}) {
    frames +=
        fmt::format("{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" pbc=\"T T T\" Properties=pos:R:3:radius:R:1\n", n,
                    side, side, side);
    for (int i = 0; i < n; ++i) frames += fmt::format("{} 0 0 1\n", std::fmod(i * step, side));
  }
  const TestFile file("a.xyz", frames);
  const Input input =
      open_input(file.path().string(), {.arc_window = 1.5, .tolerance = 0.05, .takes_box = true});
  ASSERT_TRUE(input.thinning);
  EXPECT_NEAR(input.thinning->own, 1 - std::sqrt(1 - step * step / 4), 1e-6);
}

}  // namespace
}  // namespace catena

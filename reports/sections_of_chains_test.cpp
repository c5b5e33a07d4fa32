#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "catena/bench/margins/margins.h"
#include "catena/bench/stability/cell.h"
#include "catena/bench/tube/tube.h"
#include "catena/core/readers/test_file.h"
#include "catena/reference/find_in_box.h"
#include "catena/reports/test_sections.h"

/// What stands in each section of a run file, against what it is said to be. That the keys are those of
/// run_file.md run_file_test.cpp looks after.
namespace catena::reports {
namespace {

TEST(Sections, OfScenesAreTheFrameWithMostPairs) {
  Profile p = profile_of({"CPU1"});
  bench::WorkloadSpec wide{"rod:n=50"};
  wide.options.window = 2;
  p.inputs = {{"path1:n=300"}, {"path1:n=100", true}, in_box(true), wide};
  const Json rows = section("scenes", p);
  ASSERT_EQ(rows.size(), 4u);
  const std::uint64_t pairs = exact_pairs("path1:n=300", 28);
  EXPECT_EQ(rows[0]["pairs"], pairs);
  EXPECT_EQ(rows[0]["frame"], 28);
  EXPECT_EQ(rows[0]["frames"], 56);
  EXPECT_DOUBLE_EQ(rows[0]["density"], static_cast<double>(pairs) / 300);
  const auto counts = reference::find(open_input("path1:n=300").animation->frame(28)).count;
  EXPECT_EQ(rows[0]["max_count"], *std::ranges::max_element(counts));
  EXPECT_FALSE(rows[0].contains("options"));
  std::uint64_t most = 0;
  for (std::uint32_t f = 0; f < 56; ++f) most = std::max(most, exact_pairs("path1:n=100", f));
  EXPECT_EQ(rows[1]["pairs"], most);
  EXPECT_EQ(rows[1]["frame"], "all");
  EXPECT_EQ(rows[2]["box"], "8,8,8");
  const Input melt = open_input(in_box().input, in_box().options);
  double least = 1;
  for (std::uint32_t f = 0; f < 2; ++f) {
    const bench::Margins m = bench::margins_of(melt.animation->frame(f), 0, &melt.boxes[f]);
    if (m.colliding.pairs == rows[2]["pairs"]) least = m.least;
  }
  EXPECT_EQ(rows[2]["smallest_margin"], least);
  EXPECT_GT(rows[2]["images"], 0);
  EXPECT_NE(rows[2]["summary"].get<std::string>().find("in the box 8,8,8"), std::string::npos);
  EXPECT_EQ(rows[3]["options"], " --window 2");
  EXPECT_NE(rows[0]["summary"], rows[3]["summary"]);
}

TEST(Sections, OfStabilityHaveTheSweepsBesideTheMatrix) {
  Profile p = profile_of({"CPU1"});
  EXPECT_TRUE(section("stability", p).empty());
  p.stability_n = 40;
  std::set<std::string> scenes;
  for (const Json& row : section("stability", p)) scenes.insert(row["scene"]);
  for (const std::string& scene : bench::stability_scenes(40)) EXPECT_TRUE(scenes.contains(scene)) << scene;
  for (const char* scene : {"far:n=40,exponent=23", "far:n=40,exponent=28", "grazing:n=40,margin=1e-9"})
    EXPECT_TRUE(scenes.contains(scene)) << scene;
}

/// An open tube has a sphere at both ends.
TEST(Sections, OfTubeErrorsAreOfAsManySpheresAsTheSpacingAsks) {
  Profile p;
  p.tube_spacings = {2, 1};
  std::size_t seen = 0;
  for (const Json& row : section("tube_errors", p)) {
    const bench::Tube tube = bench::tubes_named({row["tube"].get<std::string>()}).front();
    const double spacing = seen++ % 2 == 0 ? 2 : 1;
    EXPECT_EQ(row["n"], std::ceil(tube.length / spacing) + (tube.closed ? 0 : 1)) << row["tube"];
  }
  EXPECT_EQ(seen, 2 * bench::tubes_named({}).size());
}

TEST(Sections, OfWorkPrecisionAreAtTheOriginAndFarFromIt) {
  Profile p = profile_of({"aCPU2+CPU2"});
  p.tubes = {"lissajous"};
  p.tube_spacings = {2};
  p.tube_tolerance = 0.3;
  std::set<double> offsets;
  std::size_t asked = 0;
  const Json found = section("work_precision", p);
  for (const Json& point : found["points"]) {
    offsets.insert(point["offset"].get<double>());
    asked += point.value("tolerance", 0.0) == 0.3;
  }
  EXPECT_EQ(offsets, (std::set<double>{0, 1e7}));
  EXPECT_EQ(asked, 2u);
}

/// The pairs and frames of a view are those of the chain, the tree's levels those of a tree over n spheres,
/// and a rounded variant's wrong pairs are told by their numbers.
TEST(Sections, OfTheViewerShowWhatIsThere) {
  Profile p = profile_of({"CPU1", "aCPU2+CPU2", "aCPU2+CPU2/literal"});
  const TestFile file("boxes.xyz", in_boxes({"8", "20", "20"}));
  bench::WorkloadSpec boxed{file.path().string(), true};
  boxed.options.radius = 1;
  const std::string missing_some = "far:n=300,exponent=24", inventing_some = "collinear:n=300,align=general";
  p.shown = {{"path1:n=100", true}, {missing_some}, boxed, {inventing_some}};
  const Json views = section("viewer", p);
  ASSERT_EQ(views.size(), 4u);
  const auto animation = open_input("path1:n=100").animation;
  std::uint64_t most = 0;
  std::uint32_t busiest = 0;
  Json frames = Json::array();
  for (const Json& frame : views[0]["frames"]) {
    const std::uint32_t f = frame["frame"];
    frames.push_back(f);
    const Chain chain = animation->frame(f);
    EXPECT_TRUE(std::ranges::equal(array_of<Sphere>(frame["spheres"]), chain.spheres())) << f;
    const auto exact = reference::find(chain).pairs;
    EXPECT_EQ(array_of<Pair>(frame["pairs"]), exact) << f;
    if (exact.size() > most) most = exact.size(), busiest = f;
  }
  EXPECT_EQ(frames, Json::parse("[0,6,12,18,24,30,36,42,48,55]"));
  EXPECT_FALSE(views[0]["frames"][0].contains("box"));
  EXPECT_EQ(views[0]["tree_frame"], busiest);
  EXPECT_EQ(views[0]["strands"], Json::parse("[0]"));
  EXPECT_EQ(views[0]["closed"], Json::parse("[false]"));
  EXPECT_EQ(views[0]["levels"].size(), 8u) << "of 100 leaves";
  std::size_t height = 0;
  for (const Json& level : views[0]["levels"]) {
    EXPECT_EQ(level["level"], height++);
    for (const Sphere& s : array_of<Sphere>(level["spheres"])) EXPECT_GT(s.radius, 0);
  }
  const auto without = [](const std::vector<Pair>& all, const std::vector<Pair>& those) {
    Json rest = Json::array();
    for (const Pair& pair : all)
      if (!std::ranges::binary_search(those, pair)) rest.push_back({pair.i, pair.j});
    return rest;
  };
  for (const auto& [view, scene] : {std::pair(1u, missing_some), {3u, inventing_some}}) {
    const Chain chain = open_input(scene).animation->frame(0);
    const auto exact = reference::find(chain).pairs;
    const auto wrong = views[view]["wrong"];
    ASSERT_EQ(wrong.size(), 1u) << "the rounded one alone";
    EXPECT_EQ(wrong[0]["variant"], "aCPU2+CPU2/literal");
    Collisions found;
    const auto rounded = StrategyRegistry::instance().make("aCPU2+CPU2/literal");
    rounded->build(chain), rounded->find(chain, {}, found);
    std::ranges::sort(found.pairs);
    EXPECT_EQ(wrong[0]["missing"], without(exact, found.pairs));
    EXPECT_EQ(wrong[0]["invented"], without(found.pairs, exact));
    EXPECT_FALSE(wrong[0][view == 1 ? "missing" : "invented"].empty());
  }
  const Input melt = open_input(boxed.input, boxed.options);
  ASSERT_EQ(views[2]["frames"].size(), 3u);
  for (const Json& frame : views[2]["frames"]) {
    const std::uint32_t f = frame["frame"];
    const PeriodicBox& box = *box_of(melt.boxes, f);
    EXPECT_EQ(array_of<Pair>(frame["pairs"]), reference::find_in(melt.animation->frame(f), &box).pairs);
    EXPECT_EQ(frame["box"],
              Json({box.length[0], box.length[1], box.length[2], box.xy, box.xz, box.yz}))
        << "without it a pair across a face is shown as one that is apart";
  }
  EXPECT_FALSE(views[2].contains("levels")) << "a tree of images";
  EXPECT_FALSE(views[2].contains("wrong"));
}

}  // namespace
}  // namespace catena::reports

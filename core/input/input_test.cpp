#include "catena/core/input/input.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "catena/core/input/curve_input.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/test_refusal.h"
#include "catena/core/readers/test_file.h"

namespace catena {
namespace {

Chain chain_of(const std::filesystem::path& file, const InputOptions& options = {}) {
  return open_input(file.string(), options).animation->frame(0);
}

const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 0\n";

TEST(OpenInput, ReadsAFileAsOneFrame) {
  const Input input = open_input(example("rings.chain").string());
  EXPECT_EQ(input.name, example("rings.chain").string());
  EXPECT_EQ(input.animation->frames(), 1u);
  EXPECT_EQ(input.animation->frame(0).size(), 11u);
}

TEST(OpenInput, AsksForRadiiAndTakesThem) {
  const TestFile file("a.xyz", "0 0 0\n2 0 0\n6 0 0\n");
  EXPECT_REFUSAL("--radius R", file.path());
  EXPECT_REFUSAL("--radius half-spacing", file.path());
  EXPECT_EQ(chain_of(file.path(), {.radius = 0.25f})[1].radius, 0.25f);
  EXPECT_EQ(chain_of(file.path(), {.radius = 0.0f})[1].radius, 0.0f);
  EXPECT_EQ(chain_of(file.path(), {.radius = 0.25f, .centres_only = true})[1].radius, 0.25f);
  EXPECT_EQ(chain_of(file.path(), {.centres_only = true})[1].radius, 0.0f);
  EXPECT_EQ(chain_of(file.path(), {.radius_half_spacing = true})[1].radius, 1.5f);  // steps 2, 4: half of 3
  EXPECT_REFUSAL("exclude each other", file.path(), {.radius = 1.0f, .radius_half_spacing = true});
  for (const float bad :
       {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    EXPECT_REFUSAL("finite and not negative", file.path(), {.radius = bad});
}

TEST(OpenInput, HalfSpacingNeedsSteps) {
  const TestFile one("a.xyz", "0 0 0\n"), huge("b.xyz", "-3e38 -3e38 0\n3e38 3e38 0\n");
  EXPECT_REFUSAL("no usable radius", one.path(), {.radius_half_spacing = true});
  EXPECT_REFUSAL("no usable radius", huge.path(), {.radius_half_spacing = true});
}

TEST(OpenInput, RefusesARadiusForAFileWithRadii) {
  EXPECT_REFUSAL("has radii of its own", example("Neuron.swc"), {.radius = 1.0f});
  EXPECT_REFUSAL("has radii of its own", example("Neuron.swc"), {.radius_half_spacing = true});
}

TEST(OpenInput, ClosesStrandsAndTakesARepeatedPointOnce) {
  const TestFile file("a.xyz", square);
  EXPECT_EQ(chain_of(file.path(), {.radius = 1.0f}).size(), 5u);
  const Input closed = open_input(file.path().string(), {.radius_half_spacing = true, .closed = true});
  const Chain chain = closed.animation->frame(0);
  EXPECT_EQ(chain.size(), 4u);
  EXPECT_EQ(chain[0].radius, 0.5f);
  EXPECT_TRUE(chain.neighbours(0, 3));
  ASSERT_EQ(closed.warnings.size(), 1u);
  EXPECT_NE(closed.warnings[0].find("it is taken once"), std::string::npos);
}

TEST(OpenInput, TakesAPointThatIsAllOfAStrandOnce) {
  const TestFile twice("a.xyz", "1 2 3\n1 2 3\n"), once("b.xyz", "1 2 3\n");
  for (const TestFile* file : {&twice, &once})
    EXPECT_EQ(chain_of(file->path(), {.radius = 1.0f, .closed = true}).size(), 1u);
  // Where pairs name spheres by number, the numbers stay.
  const TestFile named(
      "a.chain",
      "catena-chain 1\nwindow 1\nstrand open 4\n0 0 0 1\n9 0 0 1\n9 9 0 1\n0 0 0 1\npairs 1\n1 3\nend\n");
  const Chain chain = chain_of(named.path(), {.closed = true});
  ASSERT_EQ(chain.size(), 4u);
  EXPECT_TRUE(chain.neighbours(1, 3));
  EXPECT_TRUE(chain.neighbours(0, 3));
}

TEST(OpenInput, KeepsLabelsWithTheirSpheres) {
  const TestFile file("a.csv", "strand,x,y,z\na,0,0,0\na,1,0,0\na,0,1,0\na,0,0,0\nb,5,0,0\nb,6,0,0\n");
  const Input open = open_input(file.path().string(), {.radius = 1.0f});
  EXPECT_EQ(open.labels.of(4), "6");
  const Input closed = open_input(file.path().string(), {.radius = 1.0f, .closed = true});
  ASSERT_EQ(closed.animation->frame(0).size(), 5u);
  EXPECT_EQ(closed.animation->frame(0).strands().closed, (std::vector<std::uint8_t>{1, 1}));
  EXPECT_EQ(closed.labels.of(2), "4");
  EXPECT_EQ(closed.labels.of(3), "6");
  EXPECT_EQ(closed.labels.strand_names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(open_input("rod:n=5").labels.size(), 0u);
}

TEST(OpenInput, MovesTheFramesOfAFile) {
  const TestFile file("a.xyz", "3\nt\n0 0 0\n1 0 0\n0 0 0\n3\nt\n0 0 5\n1 0 5\n0 0 5\n");
  const Input moving = open_input(file.path().string(), {.radius = 0.5f, .closed = true});
  ASSERT_EQ(moving.animation->frames(), 2u);
  EXPECT_EQ(moving.animation->frame(1).size(), 2u) << "the repeated end is dropped in every frame";
  EXPECT_EQ(moving.animation->frame(1)[1], (Sphere{1, 0, 5, 0.5f}));
  const TestFile opens("a.xyz", "2\nt\n0 0 0\n0 0 0\n2\nt\n0 0 0\n1 0 0\n");
  EXPECT_EQ(open_input(opens.path().string(), {.radius = 0.5f, .closed = true}).animation->frame(1).size(),
            2u);
  std::string text;
  for (int f = 0; f < 4; ++f) text += fmt::format("1\nt\n{} 0 0\n", f * f);
  const TestFile four("a.xyz", text);
  const Input of_four = open_input(four.path().string(), {.radius = 0.5f});
  ASSERT_EQ(of_four.animation->frames(), 4u);
  for (std::uint32_t f = 0; f < 4; ++f)
    EXPECT_EQ(of_four.animation->frame(f)[0].x, static_cast<float>(f * f)) << f;
}

TEST(OpenInput, MeasuresWhatRoundingHasCost) {
  const auto rounding = [](const std::string& x, const ReadOptions& reading = {}) {
    const TestFile file("a.csv", "x,y,z,r\n" + x + ",0,0,0.5\n" + x + ",1,0,0\n");
    return open_input(file.path().string(), {.reading = reading}).rounding;
  };
  EXPECT_EQ(rounding("16777217"), 1);
  EXPECT_EQ(rounding("16777216"), 0);
  EXPECT_EQ(rounding("16777217", {.recentre = true}), 0);
  EXPECT_EQ(rounding("16777217", {.recentre = true, .origin = {{16777216, 0, 0}}}), 0);
  EXPECT_EQ(rounding("-16777217", {.recentre = true, .origin = {{16777216, 0, 0}}}), 1);
  // It is said above a thousandth of a radius, of own radii and of one for all.
  for (const auto& [radius, said] : {std::pair(1000.5f, false), {999.5f, true}, {50.0f, true}}) {
    const TestFile points("a.csv", "x,y,z\n16777217,0,0\n"),
        spheres("b.csv", fmt::format("x,y,z,r\n16777217,0,0,{}\n", radius));
    EXPECT_EQ(open_input(points.path().string(), {.radius = radius}).warnings.size(), std::size_t{said})
        << radius;
    EXPECT_EQ(open_input(spheres.path().string()).warnings.size(), std::size_t{said}) << radius;
  }
  const TestFile points("a.csv", "x,y,z\n16777217,2,-3\n");
  using Texts = std::vector<std::string>;
  EXPECT_EQ(
      open_input(points.path().string(), {.radius = 2.0f}).warnings,
      Texts{"binary32 rounds coordinates by up to 1, 0.5 of a radius (said above 0.001); --recentre takes "
            "an origin off before"});
  EXPECT_EQ(open_input(points.path().string(), {.radius = 2.0f, .reading = {.recentre = true}}).warnings,
            Texts{"the origin 16777217,2,-3 is taken off every point"});
  const ReadOptions far{.recentre = true, .origin = {{-1, 0, 0}}};
  EXPECT_EQ(open_input(points.path().string(), {.radius = 2.0f, .reading = far}).warnings,
            Texts({"the origin -1,0,0 is taken off every point"}));
  const ReadOptions no_help{.recentre = true, .origin = {{16777216 * 3.0, 0, 0}}};
  EXPECT_EQ(open_input(points.path().string(), {.radius = 2.0f, .reading = no_help}).warnings,
            Texts({"the origin 50331648,0,0 is taken off every point",
                   "binary32 rounds coordinates by up to 1, 0.5 of a radius (said above 0.001)"}));
  // A radius of 0 has no share to lose; the warning is for the other sphere.
  const TestFile file("a.csv", "x,y,z,r\n0.1,0,0,1e-5\n16777217,1,0,0\n");
  EXPECT_EQ(open_input(file.path().string()).warnings.size(), 0u);
}

/// The same spheres in any format are warned of alike, whenever it tells their radii; a point that is left
/// out is none of them.
TEST(OpenInput, WarnsOfRoundingInEveryFormat) {
  using Texts = std::vector<std::string>;
  const auto warnings = [](const std::string& name, const std::string& text,
                           const InputOptions& options = {}) {
    const TestFile file(name, text);
    return open_input(file.path().string(), options).warnings;
  };
  const std::string at[] = {"1000000.123 0 0", "1000000.456 1 0"}, both = at[0] + "\n" + at[1] + "\n";
  const Texts said = warnings("a.csv", "x,y,z,r\n1000000.123,0,0,0.25\n1000000.456,1,0,0.0625\n", {});
  EXPECT_EQ(said, Texts{"binary32 rounds coordinates by up to 0.0185, 0.296 of a radius (said above 0.001); "
                        "--recentre takes an origin off before"});
  const std::string legacy = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n" +
                             both + "LINES 1 3\n2 0 1\n";
  EXPECT_EQ(warnings("a.vtk", legacy + "POINT_DATA 2\nFIELD f 1\nradius 1 2 double\n0.25 0.0625\n"), said);
  EXPECT_EQ(warnings("a.vtk", legacy, {.radius = 0.0625f}), said);
  EXPECT_EQ(warnings("a.obj", "v " + at[0] + "\nv " + at[1] + "\nl 1 2\n", {.radius = 0.0625f}), said);
  const std::string array = "<DataArray type=\"Float64\" format=\"ascii\" ",
                    cells = array + "Name=\"connectivity\">0 1</DataArray>" + array +
                            "Name=\"offsets\">2</DataArray>";
  const auto xml = [&](const std::string& type, const std::string& rest) {
    return fmt::format(
        "<VTKFile type=\"{0}\"><{0}><Piece>{1}<Points>{2}NumberOfComponents=\"3\">{3}</DataArray>"
        "</Points><PointData>{2}Name=\"radius\">0.25 0.0625</DataArray></PointData></Piece></{0}>"
        "</VTKFile>",
        type, rest, array, both);
  };
  EXPECT_EQ(warnings("a.vtp", xml("PolyData", "<Lines>" + cells + "</Lines>")), said);
  EXPECT_EQ(warnings("a.vtu", xml("UnstructuredGrid",
                                  "<Cells>" + cells + array + "Name=\"types\">4</DataArray></Cells>")),
            said);
  EXPECT_EQ(warnings("a.obj", "v 16777217 0 0\nv 0 0 0\nv 1 0 0\nl 2 3\n", {.radius = 1.0f}),
            Texts{"1 vertex is on no line and left out"});
}

TEST(OpenInput, TakesTheFirstPointOffEveryPointOfEveryFrame) {
  const TestFile file("a.xyz", "2\nt\n1e8 0 0\n100000001 0 0\n2\nt\n100000002 0 0\n100000003.5 1 0\n");
  const Input input = open_input(file.path().string(), {.radius = 0.5f, .reading = {.recentre = true}});
  EXPECT_EQ(input.animation->frame(0)[1].x, 1.0f);
  EXPECT_EQ(input.animation->frame(1)[1], (Sphere{3.5f, 1, 0, 0.5f}));
  EXPECT_EQ(input.rounding, 0);
}

TEST(OpenInput, RefusesToCloseATree) {
  EXPECT_REFUSAL("leave out --closed", example("Neuron.swc"), {.closed = true});
  EXPECT_REFUSAL("leave out --closed", example("branch.vtk"), {.closed = true});
  const TestFile unbranched("a.swc", "1 1 0 0 0 1 -1\n2 1 9 0 0 1 1\n3 1 9 9 0 1 2\n");
  EXPECT_REFUSAL("leave out --closed", unbranched.path(), {.closed = true});
}

TEST(OpenInput, WindowsReplaceTheRuleOfTheFile) {
  const auto rings = example("rings.chain");
  EXPECT_FALSE(chain_of(rings).neighbours(8, 10));
  const Chain wide = chain_of(rings, {.window = 2});
  EXPECT_TRUE(wide.neighbours(8, 10));
  EXPECT_TRUE(wide.neighbours(0, 8));  // the file's own pair stays
  const Chain arc = chain_of(rings, {.arc_window = 2.5});
  EXPECT_EQ(arc.exclusion().rule, Exclusion::Rule::arc_window);
  EXPECT_TRUE(arc.neighbours(8, 10));
  EXPECT_REFUSAL("exclude each other", rings, {.window = 1, .arc_window = 1.0});
  EXPECT_REFUSAL("at least 1", rings, {.window = 0});
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_REFUSAL("finite number above 0", rings, {.arc_window = bad});
}

TEST(OpenInput, NeighboursOfANeuronAreThoseOfItsTree) {
  const TestFile file("a.swc",
                      "1 1 0 0 0 1 -1\n2 3 1 0 0 1 1\n3 3 2 0 0 1 2\n4 3 1 1 0 1 2\n5 3 1 2 0 1 4\n");
  const Chain one = chain_of(file.path()), two = chain_of(file.path(), {.window = 2});
  EXPECT_EQ(one.exclusion().extra_pairs, (std::vector<Pair>{{1, 3}}));
  EXPECT_EQ(two.exclusion().extra_pairs, (std::vector<Pair>{{0, 3}, {1, 3}, {1, 4}, {2, 3}}));
  EXPECT_EQ(chain_of(file.path(), {.arc_window = 0.9}).exclusion().extra_pairs, (std::vector<Pair>{{1, 3}}));
}

TEST(OpenInput, SaysWhatIsWrongWithAFile) {
  EXPECT_REFUSAL("there is no such file", "nowhere/at_all");
  EXPECT_REFUSAL("there is no such file", "missing.swc");
  const TestFile inside("a.xyz", "0 0 0\n");
  for (const std::filesystem::path& folder : {example(""), example("."), inside.path().parent_path()})
    EXPECT_REFUSAL("is a directory", folder);
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(inside.path().parent_path().parent_path());  // by its name alone
  EXPECT_REFUSAL("is a directory", inside.path().parent_path().filename());
  std::filesystem::current_path(here);
  EXPECT_REFUSAL("no input is named", "");
  const TestFile unknown("a.docx", "x"), extensionless("a", "x"), empty("a.pdb", "");
  EXPECT_REFUSAL("no reader for '.docx' files; there are readers for: .3dg .bcc .catena .chain .cif .conf ",
                 unknown.path());
  EXPECT_REFUSAL("has no extension; name its format with --format", extensionless.path());
  EXPECT_REFUSAL("is empty", empty.path());
}

TEST(OpenInput, SaysThatAFileCannotBeOpened) {
  const TestFile file("a.swc", "1 1 0 0 0 1 -1\n");
  std::filesystem::permissions(file.path(), std::filesystem::perms::none);
  if (std::ifstream(file.path())) GTEST_SKIP() << "permissions do not bind this user";
  EXPECT_REFUSAL("check its permissions", file.path());
}

TEST(HalfMedianStep, CountsTheClosingStep) {
  CurveFile curves;
  curves.spheres = {{0, 0, 0, 0}, {2, 0, 0, 0}, {2, 8, 0, 0}};
  curves.end_strand(true);
  EXPECT_EQ(half_median_step(curves), 4.0);  // steps 2, 8, sqrt(68)
  curves.strand_closed[0] = 0;
  EXPECT_EQ(half_median_step(curves), 2.5);
  CurveFile pair;  // two spheres have one step between them, closed or not
  pair.spheres = {{0, 0, 0, 0}, {9, 0, 0, 0}, {0, 5, 0, 0}, {1, 5, 0, 0}, {2, 5, 0, 0}};
  pair.strand_first = {0, 2, 5};
  pair.strand_closed = {1, 0};
  EXPECT_EQ(half_median_step(pair), 0.5);  // of 9, 1, 1
}

// The middle one, or of an even number the two in the middle, whatever their order along the strand.
TEST(HalfMedianStep, IsOfTheStepsInTheMiddle) {
  std::vector<float> steps{1, 2, 4, 7, 16, 32};
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 6u}) {
    std::vector<float> some(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(count));
    const double median = (some[(count - 1) / 2] + some[count / 2]) / 2;
    do {
      CurveFile curves;
      float at = 0;
      curves.spheres = {{0, 0, 0, 0}};
      for (const float step : some) curves.spheres.push_back({at += step, 0, 0, 0});
      curves.end_strand();
      ASSERT_EQ(half_median_step(curves), median / 2);
    } while (std::ranges::next_permutation(some).found);
  }
}

/// A name that its text only happens to begin with is not in front of it.
TEST(Naming, PutsANameInFrontUnlessItIsThere) {
  const auto said = [](const std::string& name, const char* what) {
    try {
      naming(name, [&] { throw InputError(what); });
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(said("a", "a strand ends"), "a: a strand ends");
  EXPECT_EQ(said("s", "strand 2 ends"), "s: strand 2 ends");
  EXPECT_EQ(said("knot", "knot: is empty"), "knot: is empty");
  EXPECT_EQ(said("knot", "knot frame 2: is empty"), "knot frame 2: is empty");
  EXPECT_EQ(said("knot", "knot.xyz: is empty"), "knot: knot.xyz: is empty");
}

}  // namespace
}  // namespace catena

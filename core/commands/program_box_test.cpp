// What the program does where space repeats in a box, and where a command knows of none.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/commands/test_program.h"

namespace catena {
namespace {

using Outcome = ProgramOutcome;

TEST_F(Program, RepeatsSpaceInABox) {
  const std::string melt = "detect " + examples + "melt.data --radius 0.5";
  expect_says(melt, 0, {"8 spheres, 1 pair"});
  expect_says(melt + " --box file", 0, {"8 spheres, 2 pairs"});
  expect_says(melt + " --box 8,8,8,0,0,0 --variant ChainTree", 0, {"8 spheres, 2 pairs"});
  expect_says(melt + " --box 0,8,8", 0, {"8 spheres, 1 pair"});
  expect_refused(melt + " --box 1.5,8,8", "less than twice the reach");
  // One call may have many files, and one file many frames.
  for (const std::string command : {"margins ", "verify --variant Hybrid ", "plan --run "})
    expect_refused(command + examples + "melt.data --radius 0.5 --box 1.5,8,8",
                   "melt.data frame 0: the box is 1.5 wide along x, less than twice the reach 1");
  expect_refused(melt + " --box 1.5,8,8", "melt.data frame 0: the box is 1.5 wide");
  expect_says(
      "export " + examples + "melt.data '" + file("m.vtp") + "' --contacts --radius 0.5 --box 1.5,8,8", 2,
      {"melt.data frame 0: the box is 1.5 wide"});
  if (measures_in_this_build())
    expect_refused(
        "report --output " + file("r") + " --scene " + examples + "melt.data --radius 0.5 --box 1.5,8,8",
        "melt.data: the box is 1.5 wide");
  const std::string far = write("far.csv", "x,y,z,r\n0,0,0,1\n9663676416,0,0,1\n3,0,0,1\n");
  for (const std::string command : {"margins ", "verify --variant Hybrid ", "detect "})
    expect_refused(command + far + " --box 9,9,9", "far.csv frame 0: sphere 1 lies ");
  const std::string ring = write("ring.csv", "x,y,z,r,closed\n0,0,0,1,1\n3,0,0,1,1\n6,0,0,1,1\n");
  expect_refused("detect " + ring + " --box 9,9,9 --arc-window 1", "ring.csv: the tube winds around the box");
  expect_refused(melt + " --box 3,8", "a box is X,Y,Z");
  expect_refused(melt + " --box 3,8,a", "'a' is not a number");
}

// melt.dump says that its box is periodic, melt.data does not.
TEST_F(Program, LeavesNoBoxOutInSilence) {
  const std::string dump = examples + "melt.dump --radius 0.5", data = examples + "melt.data --radius 0.5";
  for (const std::string command : {"scaling ", "examine ", "stability --json --variant CPU1 "}) {
    expect_refused(command + dump,
                   "the box of the file, 8 x 8 x 8, repeats space, which this command does not know");
    expect_refused(command + data + " --box 9,9,9", "the box of --box, 9 x 9 x 9, repeats space");
    expect_says(command + dump + " --box none", 0, {});
  }
  expect_refused("plan " + dump, "add --run, or say --box none");
  expect_refused("report --box 9,9,9", "--box is said of an input; name it by --scene");
  if (measures_in_this_build())
    expect_refused("report --output " + file("r") + " --scene " + data + " --box 1.5,8,8",
                   "less than twice the reach");
}

TEST_F(Program, MeasuresMarginsBetweenNearestImages) {
  const std::string margins = "margins " + examples;
  expect_says(margins + "melt.data --radius 0.5 --box file", 0,
              {"8 spheres, 2 pairs; between nearest images in the box 8,8,8"});
  expect_says(margins + "melt.data --radius 0.5", 0,
              {"8 spheres, 1 pair\n", "--box file says that space repeats it"});
  expect_says(margins + "melt.dump --radius 0.5 --json", 0, {"\"box\":\"8,8,8\"", "\"pairs\":2"});
  expect_says(margins + "melt.dump --radius 0.5 --box none", 0, {"4 spheres, 0 pairs"});
  expect_refused(margins + "melt.data --radius 0.5 --box 8,8,1.9", "less than twice the reach");
}

// The pair across the face is found in what was written, too.
TEST_F(Program, ExportsTheBoxToXyzAndSaysWhereItCannot) {
  const std::string melt = examples + "melt.data --radius 0.5 --box file ";
  expect_says("export " + melt + file("a.xyz"), 0, {"8 spheres"});
  expect_says("detect " + file("a.xyz"), 0, {"8 spheres, 2 pairs"});
  expect_says("detect " + file("a.xyz") + " --box none", 0, {"8 spheres, 1 pair"});
  expect_says("export " + melt + file("a.csv"), 0,
              {"CSV table holds no box; give it with --box when it is read"});
  expect_says("verify " + melt, 0, {"melt.data", " 2 "});
  expect_refused("verify " + examples + "melt.data --radius 0.5 --box 1,1,1", "less than twice the reach");
}

/// Frames of one file whose boxes differ: a pair collides through the face of the small one alone. Each frame
/// of all is as it is alone, whoever searches it.
TEST_F(Program, SearchesEachFrameInItsOwnBox) {
  std::string dump;
  for (const char* width : {"20", "8", "20"})
    dump += std::string("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 ") +
            width + "\n0 20\n0 20\nITEM: ATOMS id mol x y z\n1 1 0.3 4 4\n2 2 7.6 4 4\n3 3 4 4 4\n";
  const std::string input = write("boxes.dump", dump),
                    box = " --radius 0.5 --box file --variant aCPU2+CPU2 --frame ";
  const auto pairs = [&](const std::string& frame) {
    expect_says("detect " + input + box + frame + " --pairs '" + file("p.csv") + "'", 0, {});
    return text_of(file("p.csv"));
  };
  const auto contacts = [&](const std::string& name, const std::string& frame) {
    expect_says("export " + input + " '" + file(name) + "' --contacts" + box + frame, 0, {});
  };
  const std::string empty = pairs("0"), one = pairs("1");
  EXPECT_EQ(std::ranges::count(empty, '\n'), 1);
  EXPECT_EQ(std::ranges::count(one, '\n'), 2);
  EXPECT_EQ(pairs("2"), empty);
  EXPECT_EQ(pairs("all"), one);
  contacts("all.vtp", "all");
  for (const std::string frame : {"0", "1", "2"}) {
    contacts("alone.vtp", frame);
    EXPECT_EQ(text_of(file("all_" + frame + ".vtp")), text_of(file("alone.vtp"))) << frame;
  }
  EXPECT_NE(text_of(file("all_0.vtp")), text_of(file("all_1.vtp")));
  const Outcome verified = run("verify " + input + box + "all --json");
  EXPECT_EQ(verified.code, 0) << verified.output;
  std::istringstream lines(verified.output);
  std::vector<int> exact;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('{')) exact.push_back(nlohmann::json::parse(line)["exact_pairs"]);
  EXPECT_EQ(exact, (std::vector<int>{0, 1, 0})) << verified.output;
}

}  // namespace
}  // namespace catena

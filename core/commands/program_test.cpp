#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catena/core/commands/test_program.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

using Outcome = ProgramOutcome;

const std::string examples = std::string(CATENA_SOURCE_DIR) + "/core/readers/examples/";

TEST_F(Program, SaysWhatItIs) {
  expect_says("--help", 0, {"detect", "verify", "fuzz", "list"});
  const Outcome version = run("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.output, CATENA_VERSION "\n");
  expect_says("detect --help", 0, {"--variant", "--frame", "--pairs"});
}

TEST_F(Program, RefusesBadUsageInOneLine) {
  expect_refused("", "A subcommand is required");
  expect_refused("nonsense", "no command is named 'nonsense'");
  expect_refused("detect", "INPUT is required");
  expect_refused("detect nowhere", "no scene is named 'nowhere'");
  expect_refused("detect path1:x=1", "no parameter 'x'");
  expect_refused("detect path1:n=10 --frame 99", "there is no frame 99");
  for (const char* frame : {"first", "1x", "1.0", "-1", "+1", "'1 '", "4294967296", "al", "all2"})
    expect_refused(std::string("detect path1:n=10 --frame=") + frame,
                   "must be a frame number from 0, or all");
  expect_refused("detect path1:n=10 --frame 56", "there is no frame 56");
  expect_refused("detect path1:n=10 --variant Fastest", "'Fastest'");
  expect_refused("detect path1:n=10 --any --counts-only", "--any");
  expect_refused("detect path1:n=10 --counts-only --pairs p.csv", "--counts-only");
  expect_refused("detect path1:n=10 --radius wide", "--radius wide");
  expect_refused("detect path1:n=10 --radius -1", "--radius -1");
  expect_refused("detect path1:n=10 --window 2 --arc-window 1", "excludes");
  expect_refused("detect path1:n=10 --window 0", "window");
  expect_refused("detect path1:n=3000 --variant bGPU2@host+CPU2", "aGPU2");
  expect_refused("detect coincident:n=200 --pair-limit 5", "5");
  expect_refused("detect path1:n=10 --pair-limit -5", "--pair-limit: -5 is not a whole number from 0");
  expect_refused("detect path1:n=10 --pair-limit 1.5", "1.5 is not a whole number");
  expect_refused("fuzz --seconds 0", "--seconds: 0 is not a number from 0.001 to 1e+09");
  expect_refused("fuzz --timeout -1", "--timeout: -1 is not a number from 0 to 1e+09");
  expect_refused("enumerate --walks 0", "--walks: 0 is not a whole number from 1 to ");
  expect_refused("enumerate --walks 3 --lattice hexagon", "--lattice: hexagon is none of ");
  expect_refused("closed-form --side 0", "--side: 0 is not a whole number from 1 to 1290");
  expect_refused("knots --n 3", "--n: 3 is not a whole number from 16");
  expect_refused("knots --knot 3_1", "needs the polygon that it is of");
  expect_refused("knots tight_knot:n=100", "say what was published of it");
  expect_refused("knots tight_knot:n=100 --knot 9_47",
                 "nothing published is carried of a knot '9_47'; there are 3_1_328");
  expect_refused("knots tight_knot:n=100 --knot 3_1 --ropelength 33", "excludes");
  expect_refused("knots tight_knot:n=100 --ropelength -1", "--ropelength");
  expect_refused("knots path1:n=100 --ropelength 33", "path1:n=100: strand 0 is open");
  expect_refused("knots " + examples + "9_47-cubiclattice.txt --knot knotted", "say --closed");
  expect_refused("knots nowhere.vect --knot 3_1", "nowhere.vect");
  expect_refused("growth serpentine:side=10 --n 32000", "serpentine:side=10 has 1000 spheres at every n");
  expect_refused("growth yarn --variant aCPU2+Dual --variant nanoflann",
                 "nanoflann does not count what it compares");
  expect_refused("pivot --n 95 --exponent", "--n must be at least 96 with --exponent");
  expect_refused("pivot --n 50 --out w.csv", "w.csv: a walk is written as .chain");
  expect_refused("pivot --n 50 --out -", "-: is no file to write");
  expect_refused("margins - - --format csv", "standard input can be read once");
  expect_refused("margins path1:n=200 yarn:n=100 --frame 3",
                 "yarn:n=100 has 1 frame, from 0; there is no frame 3");
  expect_refused("export path1:n=10 x.csv --variant nope", "--variant finds what --contacts writes");
  expect_refused("report --from R --scene nosuch", "excludes");
  expect_refused("knots torus_knot:n=64 --thickness 1e308", "the thickness told does not fit into binary32");
  expect_refused("growth yarn --n 10", "--n: 10 is not a whole number from");
  expect_says("growth --help", 0, {"32,000 or more"});
  expect_says("scaling path1:n=1", 0, {"path1:n=1: 1 sphere; of a rank"});
  expect_refused("pivot --n 1", "--n: 1 is not a whole number from");
  expect_refused("pivot --n 5e6 --rotations any", "--n must be at most 2^22 with --rotations any");
  expect_refused("pivot --n 50 --rotations some", "--rotations: some is none of lattice, any");
  expect_refused("pivot --n 50 --rotations any --at-once", "--at-once goes with --rotations lattice");
  expect_refused("pivot --n 50 --moves 64 --out /nowhere/x.chain", "cannot write /nowhere/x.chain");
  expect_refused("scaling path1:n=300 --ranks 1", "--ranks: 1 is not a whole number from 2 to 4096");
  expect_refused("plan nowhere", "no scene is named 'nowhere'");
  expect_refused("calibrate --variant Nope",
                 "there is no option --variant here; see catena calibrate --help");
  expect_refused("export path1:n=10 x.foo", "nothing writes '.foo' files");
  expect_refused("export path1:n=10 /nowhere/x.csv", "cannot write /nowhere/x.csv");
  expect_refused("fuzz --seed -1", "--seed: -1 is not a whole number from 0");
  expect_refused("report --seed -1", "--seed: -1 is not a whole number from 0");
  expect_refused("detect path1:n=1e20", "must be a whole number");
  expect_refused("detect path1:n=10 --pairs /nowhere/p.csv", "cannot write /nowhere/p.csv");
  expect_refused("verify path1:n=10 --variant None", "'None'");
  expect_refused("fuzz --scene-family none", "no family 'none'");
  expect_refused("fuzz --replay /nowhere.chain", "/nowhere.chain");
}

TEST_F(Program, CountsAndTurnsWalks) {
  expect_says("pivot --n 40 --moves 64 --rotations any", 0,
              {"40 points", "self-avoiding by the exact reference"});
  expect_says("pivot --n 40 --moves 64 --at-once", 0, {"\n1 at once", "\n39 at once", "times as much"});
  expect_says(
      "pivot --n 100 --moves 64 --exponent", 0,
      {"3 points: ", "\n6 points: ", "\n12 points: ", "\n25 points: ", "\n50 points: ", "\n100 points: "});
  expect_says("enumerate --walks 4 --lattice diamond", 0, {"A001394", "108"});
}

TEST_F(Program, JudgesKnotsByWhatWasPublishedOfThem) {
  expect_says("knots --n 32", 0, {"hopf: the tight Hopf link", "published  ropelength 25.13", "within"});
  const std::string trefoil = "knots tight_knot:p=2,margin=0,n=600 ";
  expect_says(trefoil + "--knot 3_1", 0, {"within"});
  expect_says(trefoil + "--ropelength 60", 1, {"NOT WITHIN: ", "fit in, above"});
  expect_says(trefoil + "--ropelength 20 --variant CPU1", 1, {"NOT WITHIN: ", "touch at a radius of"});
  expect_says(trefoil + "--thickness 1e-3", 1, {"NOT WITHIN: ", "do not touch"});
  expect_says("knots tight_knot:p=2,margin=0,n=64 --knot 3_1_328", 1,
              {", 375 struts", "struts     are of its shape 100 steps of tightening later"});
  expect_says("knots " + examples + "9_47-cubiclattice.txt --closed --knot knotted", 0,
              {"208 vertices", "within"});
}

TEST_F(Program, LeavesOutWhatATolerancePermits) {
  const std::string dense = "detect path1:n=5000,spacing=0.2,frame=3 ";
  expect_says(dense + "--tolerance 0.1 --arc-window pi/2", 0,
              {"of 5000 spheres are kept; without the others", "auto"});
  expect_says(dense + "--tolerance 0.1 --arc-window pi/2 --json", 0,
              {"\"thinned\":{\"tolerance\":0.1,\"of\":5000"});
  expect_says("verify path2:n=600,spacing=0.3 --tolerance 0.1 --arc-window pi/2 --variant Hybrid", 0,
              {"exact"});
  expect_says("detect " + examples + "melt.dump --radius 0.5 --tolerance 0.3 --arc-window 1.5", 0,
              {"every sphere is kept", "4 spheres, 2 pairs"});
  expect_refused(dense + "--tolerance 0.1", "give --arc-window F too");
  expect_refused(dense + "--tolerance 1 --arc-window pi/2", "above 0 and below 1");
  expect_refused(dense + "--tolerance wide --arc-window pi/2", "--tolerance");
}

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

TEST_F(Program, ReadsStandardInputAsWhatItIsSaidToBe) {
  expect_says("detect - --format vtp < " + examples + "branch.vtp", 0, {"7 spheres"});
  expect_refused("detect - < " + examples + "branch.vtp", "standard input: ");
  expect_refused("detect - --format vtp < /dev/null", "standard input: is empty");
  // Of a pipe's several pieces, the last line too.
  const std::string last =
      write("last.xyzr", std::string((3 << 20) / 2, '\n') + "0 0 0 1\n9 0 0 1\n0 1 0 1\n");
  expect_says("detect - --format xyzr < " + last, 0, {"3 spheres, 1 pair"});
}

// Some open their input again, for the reference or for each section.
TEST_F(Program, TakesStandardInputWhereverItTakesAFile) {
  const std::string from = " - --format vtp < " + examples + "branch.vtp";
  for (const std::string command :
       {"detect", "detect --frame all", "verify --variant CPU1", "plan", "plan --run", "margins", "scaling",
        "examine", "regret --variant CPU1 --rounds 2 --seconds 0.01", "stability --variant CPU1",
        "verify --variant aCPU2+CPU2 --certify"})
    expect_says(command + from, 0, {});
  expect_says("export - " + file("of.csv") + from.substr(2), 0, {"7 spheres"});
}

// Where nobody can be asked, nothing was verified, and that is no success.
TEST_F(Program, VerifiesNothingByNobody) {
  const auto& variants = StrategyRegistry::instance().variants();
  const auto absent =
      std::ranges::find_if(variants, [](const VariantInfo& v) { return v.unavailable.has_value(); });
  if (absent == variants.end()) GTEST_SKIP() << "every variant is available here";
  expect_refused("verify path1:n=50 --variant '" + absent->name + "'",
                 absent->name + " is not available here: ");
  for (const std::string command : {"stability yarn:n=50", "regret yarn:n=50"})
    expect_refused(command + " --variant '" + absent->name + "'", absent->name + " is not available here: ");
  expect_says("verify path1:n=50 --variant CPU1 --variant '" + absent->name + "'", 0,
              {"CPU1", "1 unavailable"});
}

TEST_F(Program, KnowsWhatWasMeant) {
  expect_refused("detct path1", "did you mean 'detect'?");
  expect_refused("detect pth1:n=10", "did you mean 'path1'?");
  expect_refused("detect path1:spcing=2", "did you mean 'spacing'?");
  expect_refused("detect path1:n=10 --variant aCPU2+CPU3", "did you mean 'CPU2'?");
  expect_refused("detect path1:n=10 --variant cpu1", "did you mean 'CPU1'?");
  expect_refused("detect path1:n=10 --variant aCPU2+CPU2/robst", "did you mean 'robust'?");
  expect_refused("fuzz --scene-family coils", "did you mean 'coil'?");
  expect_refused("detect path1:n=100,fram=3", "did you mean 'frame'?");
  expect_refused("detect path1:n=10 --pair p.csv", "there is no option --pair here; did you mean '--pairs'?");
  expect_refused("errors lisajous", "did you mean 'lissajous'?");
  expect_refused("export path1:n=10 out.cvs", "did you mean '.csv'?");
}

/// An algorithm of a device, where there is none: why, and what runs instead.
TEST_F(Program, NamesTheHostTwinWhereThereIsNoDevice) {
  const Outcome r = run("detect path1:n=100 --variant aGPU2+GPUv2");
  if (r.code == 0) GTEST_SKIP() << "there is a device";
  expect_refused("detect path1:n=100 --variant aGPU2+GPUv2", "'aGPU2@host' runs the same on the host");
  EXPECT_NE(r.output.find("device"), std::string::npos) << r.output;
}

TEST_F(Program, TakesWholeNumbersWithAnExponent) {
  expect_says("detect path1:n=1e3 --frame 28", 0, {"1000 spheres"});
  expect_says("detect coincident:n=60 --pair-limit 1e3 --window 1e0", 0, {"812 pairs"});
}

TEST_F(Program, KeepsPairsOnlyForWhoReadsThem) {
  const auto kept = [&](const std::string& options) {
    const auto line = nlohmann::json::parse(run("detect coincident:n=60 --plan --json" + options).output);
    for (const auto& step : line["plan"])
      if (step["step"] == "pair list") return !step["left_out"].get<bool>();
    ADD_FAILURE() << "no word of pairs";
    return false;
  };
  EXPECT_FALSE(kept(""));
  EXPECT_TRUE(kept(" --pairs '" + file("p.csv") + "'"));
  EXPECT_TRUE(kept(" --pair-limit 900"));
  EXPECT_FALSE(kept(" --counts '" + file("c.csv") + "'"));
}

TEST_F(Program, PrintsTheFrameItUsed) {
  expect_says("detect path1:n=100,frame=3", 0, {"frame 3: 100 spheres"});
  EXPECT_EQ(nlohmann::json::parse(run("detect path1:n=100,frame=3 --json").output)["frame"], 3);
  EXPECT_EQ(nlohmann::json::parse(run("verify path1:n=100,frame=3 --variant CPU1 --json").output)["frame"],
            3);
  EXPECT_EQ(nlohmann::json::parse(run("margins path1:n=100,frame=3 --json").output)["frame"], 3);
  const std::string pairs = file("p.csv");
  expect_says("detect path1:n=1000,frame=28 --pairs '" + pairs + "'", 0, {"frame 28"});
  EXPECT_TRUE(text_of(pairs).starts_with("frame,i,j,label_i,label_j,strand_i,strand_j,index_i,index_j\n28,"))
      << text_of(pairs).substr(0, 40);
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

TEST_F(Program, ListsVariantsScenesAndReaders) {
  expect_says("list", 0, {"aCPU2+CPU2", "path1", ".swc", "subtree=384"});
  const std::string spoken = run("list").output;
  const std::string scale = "factor on every coordinate and radius";
  EXPECT_NE(spoken.find(scale), std::string::npos);
  EXPECT_EQ(spoken.find(scale), spoken.rfind(scale)) << "what is common to all scenes, once";
  const std::string printed = run("list --json").output;
  EXPECT_EQ(std::ranges::count(printed, '\n'), 1);
  const auto list = nlohmann::json::parse(printed);
  EXPECT_GE(list["variants"].size(), 40u);
  for (const auto& variant : list["variants"]) {
    for (const char* key :
         {"name", "arithmetic", "device", "unavailable", "stages", "exact", "peer", "evidence"})
      EXPECT_TRUE(variant.contains(key)) << variant << " lacks " << key;
    EXPECT_EQ(variant["device"], variant["on_device"]) << variant;
  }
  EXPECT_GE(list["scenes"].size(), 20u);
  for (const auto& scene : list["scenes"]) EXPECT_FALSE(scene["parameters"].empty()) << scene["name"];
}

TEST_F(Program, SaysTheMostOfAnySphere) {
  const std::string counts = file("counts.jsonl");
  for (const char* input : {"path1:n=1000 --frame 28", "yarn:n=300", "coincident:n=60"}) {
    const auto line = nlohmann::json::parse(
        run(std::string("detect ") + input + " --json --counts '" + counts + "'").output);
    std::istringstream rows(text_of(counts));
    int most = 0, first = -1;
    for (std::string row; std::getline(rows, row);) {
      const int count = nlohmann::json::parse(row)["count"];
      most = std::max(most, count);
      if (first < 0) first = count;
    }
    EXPECT_EQ(line["max_count"], most) << input;
    EXPECT_GT(most, 0) << input;
    if (std::string_view(input).starts_with("path1")) {
      EXPECT_LT(first, most) << "it is not the first sphere's";
    }
  }
}

TEST_F(Program, DetectsWithEveryKindOfAnswer) {
  expect_says("detect coincident:n=60 --any", 0, {"60 spheres, collides"});
  expect_says("detect rod:n=60 --any", 0, {"does not collide"});
  expect_says("detect coincident:n=60 --counts-only", 0, {"812 pairs, at most 28 a sphere"});
  expect_says("detect path1:n=100 --frame all", 0, {"frame 0:", "frame 55:"});
  const auto line = nlohmann::json::parse(run("detect coincident:n=60 --json").output);
  EXPECT_EQ(line["pairs"], 812);
  EXPECT_EQ(line["collides"], true);
  EXPECT_EQ(line["n"], 60);
  EXPECT_FALSE(nlohmann::json::parse(run("detect coincident:n=60 --any --json").output).contains("pairs"));
}

TEST_F(Program, ReadsFilesWithAndWithoutRadii) {
  expect_says("detect '" + examples + "Neuron.swc'", 0, {"spheres"});
  expect_says("detect '" + examples + "9_47-cubiclattice.txt' --closed --radius 0.5", 0, {"1 pair,"});
  expect_says("detect '" + examples + "9_47-cubiclattice.txt' --radius half-spacing --arc-window 1.57", 0,
              {"pairs"});
  expect_says("detect '" + examples + "rings.chain' --window 3", 0, {"spheres"});
}

TEST_F(Program, VerifiesByReferenceAndByCertificate) {
  expect_says("verify coincident:n=60 path1:n=200", 0, {"aCPU2+CPU2", "CPU1", "exact"});
  const Outcome right = run("verify coincident:n=60 path1:n=200");
  EXPECT_TRUE(right.output.starts_with("Every exact variant is exact, on 2 inputs: ")) << right.output;
  // How many arithmetics and reasons there are depends on what was built in; each has one table or line of
  // its own, and a table has few answers to an input, whatever the number of variants.
  const auto lines_that_begin = [&](const std::string& words) {
    std::istringstream lines(right.output);
    std::set<std::string> distinct;
    std::size_t found = 0;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(words)) ++found, distinct.insert(line.substr(0, line.find(": ")));
    return std::pair{found, distinct.size()};
  };
  const std::size_t tables = lines_that_begin("  input ").first;
  EXPECT_GE(tables, 3u) << right.output;
  EXPECT_LE(lines_that_begin("  coincident:n=60 ").first, 2 * tables) << right.output;
  const auto [absent, reasons] = lines_that_begin("not available here, ");
  EXPECT_EQ(absent, reasons) << right.output;
  const Outcome wrong = run("verify lattice:n=60 --variant mutant:less-for-less-equal --variant CPU1");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_TRUE(wrong.output.starts_with("mutant:less-for-less-equal on lattice:n=60: WRONG")) << wrong.output;
  EXPECT_NE(wrong.output.find("NOT every exact variant is exact. Wrong: mutant:less-for-less-equal\n"),
            std::string::npos)
      << wrong.output;
  expect_says("verify coincident:n=60 --variant Nothing", 2, {"Nothing"});
  expect_says("verify coincident:n=60 --variant aCPU2+Dual --certify", 0, {"certified"});
  expect_says("verify coincident:n=60 --variant mutant:less-for-less-equal lattice:n=60", 1, {"missing"});
  std::istringstream lines(
      run("verify coincident:n=60 --variant aCPU2+CPU2/literal --variant CPU1 --json").output);
  std::vector<nlohmann::json> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["verdict"], "differs");
  EXPECT_EQ(rows[0]["missing"], 812);
  EXPECT_EQ(rows[1]["verdict"], "exact");
}

TEST_F(Program, FuzzFindsStoresAndReplays) {
  const std::string failures = file("failures");
  expect_says("fuzz --cases 30", 0, {"30 chains", "no finding", "deepest tree"});
  expect_says("fuzz --variant CPU1 --seconds 0.2 --scene-family coil", 0, {"coil", "no finding"});
  expect_says("fuzz --variant mutant:less-for-less-equal --cases 2000 --failures '" + failures + "'", 1,
              {"FOUND by case", "catena-chain 1", "run it again"});
  std::string stored;
  for (const auto& entry : std::filesystem::directory_iterator(failures)) stored = entry.path().string();
  ASSERT_FALSE(stored.empty());
  expect_says("fuzz --replay '" + stored + "'", 0, {"every property holds"});
  expect_says("fuzz --replay '" + stored + "' --variant mutant:less-for-less-equal", 1, {"pair set"});
}

}  // namespace
}  // namespace catena

// What the program refuses in one line, and what it takes that was meant.
#include <gtest/gtest.h>

#include <string>

#include "catena/core/commands/test_program.h"

namespace catena {
namespace {

using Outcome = ProgramOutcome;

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
  expect_refused("detect path1:n=10 --radius 1e-50",
                 "--radius 1e-50: is no 0, but binary32 has no radius so small");
  expect_refused("detect path1:n=10 --window 2 --arc-window 1", "excludes");
  expect_refused("detect path1:n=10 --window 0", "window");
  expect_refused("detect path1:n=3000 --variant bGPU2@host+CPU2", "aGPU2");
  expect_refused("detect coincident:n=200 --pair-limit 5", "more than the limit of 5");
  expect_says("detect path1:n=1000 --frame all --pair-limit 41", 2,
              {"catena: path1:n=1000 frame 21: found 42 "});
  for (const char* drawn : {"a.vtp", "A.OBJ", "a.chain", "a.catena", "a.xyz", "a.json"})
    for (const char* table : {" --pairs ", " --counts "})
      expect_refused(std::string("detect path1:n=10") + table + drawn, "tables are CSV or JSON lines");
  for (const char* kept_none : {"--counts-only", "--any"})
    expect_refused(std::string("detect coincident:n=200 --pair-limit 5 ") + kept_none,
                   "--pair-limit is for pairs that are kept");
  expect_refused("detect path1:n=10 --pair-limit -5", "--pair-limit: -5 is not a whole number from 0 on");
  expect_refused("detect path1:n=10 --pair-limit 1.5", "1.5 is not a whole number");
  expect_refused("fuzz --seconds 0", "--seconds: 0 is not a number from 0.001 to 1e+09");
  expect_refused("fuzz --timeout -1", "--timeout: -1 is not a number from 0 to 1e+09");
  expect_refused("enumerate --walks 0", "--walks: 0 is not a whole number from 1 to ");
  expect_refused("enumerate --walks 3 --lattice hexagon", "--lattice: hexagon is none of ");
  expect_refused("closed-form --side 0", "--side: 0 is not a whole number from 1 to 1290");
  expect_refused("knots --n 3", "--n: 3 is not a whole number from 16 on");
  for (const auto& [command, least] :
       {std::pair("knots", "16"), {"growth", "32000"}, {"pivot", "64"}, {"pivot", "2"}})
    expect_says(std::string(command) + " --help", 0, {std::string(":from ") + least + " on"});
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
  expect_refused("growth yarn --n 10", "--n: 10 is not a whole number from 32000 on");
  expect_says("scaling path1:n=1", 0, {"path1:n=1: 1 sphere; of a rank"});
  expect_refused("pivot --n 1", "--n: 1 is not a whole number from 2 on");
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

}  // namespace
}  // namespace catena

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "catena/core/commands/test_program.h"
#include "catena/properties/fuzz/failure_store.h"

/// `catena fuzz` on what would take it along.
namespace catena::properties {
namespace {

class FuzzProgram : public Program {
 protected:
  std::vector<std::filesystem::path> stored() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(file("failures")))
      files.push_back(entry.path());
    return files;
  }
  /// Of a sequence: its chains' numbers end their names.
  std::vector<std::filesystem::path> stored_in_order() const {
    auto files = stored();
    std::ranges::sort(files, {},
                      [](const auto& path) { return path.string().substr(path.string().size() - 7); });
    return files;
  }
  static std::string replaying(const std::vector<std::filesystem::path>& files) {
    std::string arguments;
    for (const auto& path : files) arguments += " --replay '" + path.string() + "'";
    return arguments;
  }
  std::string at(const std::string& arguments) const {
    return "fuzz --failures '" + file("failures") + "' " + arguments;
  }
};

TEST_F(FuzzProgram, TellsHowManyChainsAMinute) {
  const std::string told = run(at("--variant aCPU2+CPU2 --seconds 1")).output;
  double cases = 0, seconds = 0, a_minute = 0;
  ASSERT_EQ(std::sscanf(told.c_str(), "%lf chains in %lf s (%lf a minute)", &cases, &seconds, &a_minute), 3)
      << told;
  EXPECT_GE(seconds, 1);
  EXPECT_NEAR(a_minute / (60 * cases / seconds), 1, 0.06) << "seconds have one digit behind the point";
}

TEST_F(FuzzProgram, CountsAVariantOnceHoweverOftenItIsNamed) {
  expect_says(at("--cases 1 --variant CPU1 --variant CPU1"), 0,
              {"1 chain in ", " on 1 variant, 0 refusals "});
  expect_says(at("--cases 2 --variant CPU1 --variant Grid"), 0, {"2 chains in ", " on 2 variants, "});
}

TEST_F(FuzzProgram, ACrashLeavesItsChain) {
  const std::string variant = "--variant fault:crashes-past-8-spheres";
  expect_says(at("--cases 500 " + variant), 1,
              {"FOUND (family ", "pair set: crashed: Segmentation fault", "shrunk to 9 spheres",
               "catena-chain 1", "run it again"});
  ASSERT_EQ(stored().size(), 1u);
  EXPECT_EQ(load_chain(stored().front()).size(), 9u);
  expect_says(("fuzz " + variant + " --replay '" + stored().front().string() + "'"), 1,
              {stored().front().string(), "pair set: crashed: Segmentation fault"});
}

TEST_F(FuzzProgram, AHangLeavesItsChain) {
  const std::string variant = "--variant fault:hangs-past-8-spheres";
  expect_says(at("--cases 500 --timeout 0.5 --scene-family coil " + variant), 1,
              {"pair set: hung: no end after 0.5 s", "catena-chain 1", "run it again"});
  ASSERT_EQ(stored().size(), 1u);
  EXPECT_GT(load_chain(stored().front()).size(), 8u);
}

TEST_F(FuzzProgram, ACrashThatDependsOnHistoryIsASequence) {
  const std::string variant = "--variant fault:crashes-after-a-longer-chain";
  expect_says(at("--cases 500 " + variant), 1,
              {"crashed: Segmentation fault",
               "it depends on history: a new object does so after these 2 chains, in this order",
               "-1.chain --replay "});
  const auto files = stored_in_order();
  ASSERT_EQ(files.size(), 2u);
  expect_says(("fuzz " + variant + replaying(files)), 1, {"crashed: Segmentation fault"});
}

/// Before the search, or a finding would be lost; what can no longer be stored is printed, and is a finding
/// still.
TEST_F(FuzzProgram, LosesNoFindingToAFolder) {
  const std::string mutant = "fuzz --variant mutant:grid-truncates-toward-zero --cases 5000 --failures ";
  expect_refused(mutant + "/dev/null/x", "cannot make the folder /dev/null/x: /dev/null is none");
  expect_refused("counterexamples --out /dev/null/x",
                 "cannot make the folder /dev/null/x: /dev/null is none");
  write("taken", "");
  std::filesystem::create_symlink("nowhere/else", file("failures"));
  expect_says(mutant + "'" + file("failures") + "'", 1,
              {"FOUND by case ", "catena-chain 1", "cannot write "});
  std::filesystem::remove(file("failures"));
  expect_says("fuzz --variant fault:crashes-past-8-spheres --cases 500 --failures '" + file("taken") + "'", 2,
              {"cannot make the folder "});
  expect_refused("fuzz --replay x.chain --cases 5", "excludes");
}

/// What is replayed is one chain of spheres, and nothing that was read as one.
TEST_F(FuzzProgram, ReplaysNoFileThatHoldsMoreOrLess) {
  const std::string points = write("points.xyz", "0 0 0\n.5 0 0\n.3 0 0\n"),
                    box = "Lattice=\"9 0 0 0 9 0 0 0 9\" Properties=pos:R:3:radius:R:1\n",
                    frame = "Properties=pos:R:3:radius:R:1\n0 0 0 1\n",
                    frames = write("frames.xyz", "1\n" + frame + "1\n" + frame),
                    repeats = write("repeats.xyz", "1\n" + box + "0 0 0 1\n"),
                    good = write("good.xyz", "1\n" + frame);
  for (const std::string command : {"fuzz --variant Grid --replay ", "counterexamples --replay "}) {
    expect_refused(command + points, "points.xyz: the file has no radii, and a replay is of spheres");
    expect_refused(command + frames, "frames.xyz: the file has several frames, and a replay is of one");
    expect_refused(command + repeats, "repeats.xyz: the box of the file, 9 x 9 x 9, repeats space");
  }
  // Nor is a box heeded that does not repeat it.
  const std::string open = write("open.dump",
                                 "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\n"
                                 "ITEM: ATOMS id x y z radius\n1 0 0 0 1\n");
  for (const std::string& file : {good, open})
    expect_says("fuzz --variant Grid --replay " + file, 0, {"1 sphere, 0 pairs: every property holds"});
}

TEST_F(FuzzProgram, AnInterruptPrintsWhatWasDone) {
  for (const std::string signal : {"INT", "TERM"}) {
    const ProgramOutcome r =
        shell("timeout -s " + signal + " 1 '" CATENA_PROGRAM "' fuzz --variant CPU1 --seconds 100 > '" +
              file("out") + "'; echo code $? >&2");
    EXPECT_NE(r.output.find("interrupted: "), std::string::npos) << r.output;
    EXPECT_NE(r.output.find("deepest tree"), std::string::npos) << r.output;
    EXPECT_NE(r.output.find("code 124"), std::string::npos) << "timeout's own: " << r.output;
  }
}

TEST_F(FuzzProgram, NoMarginIsToldWhereNoneWasMet) {
  expect_says("fuzz --variant Grid --cases 2 --max-spheres 1", 0, {"smallest margin       none\n"});
  expect_says("fuzz --variant Grid --cases 200 --scene-family ulps", 0, {"smallest margin      2^-"});
}

TEST_F(FuzzProgram, AFailureThatDependsOnHistoryIsASequence) {
  const std::string variant = "--variant mutant:stale-after-a-longer-chain";
  expect_says(at("--cases 1000 " + variant), 1,
              {"it depends on history: a new object fails after these 2 chains, in this order",
               "-1.chain --replay "});
  const auto files = stored_in_order();
  ASSERT_EQ(files.size(), 2u);
  expect_says(("fuzz " + variant + replaying(files)), 1,
              {files[1].string() + ": mutant:stale-after-a-longer-chain: "});
}

TEST_F(FuzzProgram, AReplayFailsWhereAnyOfItsChainsDoes) {
  const std::string bad = write(
                        "bad.chain",
                        "catena-chain 1\nwindow 1\nstrand open 1\n0 -1 0 1\nstrand open 1\n0 1 0 1\nend\n"),
                    good = write("good.chain", "catena-chain 1\nwindow 1\nstrand open 1\n0 0 0 1\nend\n"),
                    variant = "fuzz --variant mutant:grid-truncates-toward-zero --replay ";
  expect_says(variant + good, 0, {"every property holds"});
  expect_says(variant + bad, 1, {"pair set: "});
  expect_says(variant + bad + " --replay " + good, 1, {"pair set: ", "every property holds"});
  expect_says(variant + good + " --replay " + bad, 1, {"pair set: ", "every property holds"});
}

TEST_F(FuzzProgram, ARunMeetsMoreThan65536Spheres) {
  expect_says(at("--cases 1 --variant mutant:16-bit-ids"), 1, {"(giants, seed 1)", "pair set"});
}

TEST_F(FuzzProgram, RefusesARunOfNothing) {
  expect_refused("fuzz --cases 0", "--cases");
  expect_refused("fuzz --timeout -1", "--timeout");
}

}  // namespace
}  // namespace catena::properties

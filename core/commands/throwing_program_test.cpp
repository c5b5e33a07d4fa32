#include <gtest/gtest.h>
#include <sys/mount.h>

#include <filesystem>
#include <string>

#include "catena/core/commands/test_program.h"

/// The program with a variant that throws, and on a full disk.
namespace catena {
namespace {

const std::string number = "mutant:throws-a-number", range = "mutant:throws-past-32-spheres";

class ThrowingProgram : public Program {};

TEST_F(ThrowingProgram, NamesTheVariant) {
  const std::string knot = "'" CATENA_SOURCE_DIR "/core/readers/examples/rings.chain'";
  expect_refused("detect path1:n=100 --variant " + range, range + " threw: stack slot 32 of 32");
  expect_refused("detect " + knot + " --variant " + number, number + " threw: a foreign exception");
  expect_says("detect path1:n=30 --variant " + range, 0, {"30 spheres"});
  expect_says("verify path1:n=100 --variant " + range + " --variant CPU1", 1,
              {range, "WRONG: threw: stack slot 32 of 32", "CPU1", "exact"});
  expect_says("verify " + knot + " --variant " + number, 1, {"WRONG: threw: a foreign exception"});
  expect_says("stability path1:n=100 --variant " + range + " --json", 1, {"threw: stack slot 32 of 32"});
}

/// The report is made of the others, says whose fault it was, and ends as a failed check.
TEST_F(ThrowingProgram, IsOutlivedByTheReport) {
  if (!measures_in_this_build()) GTEST_SKIP() << "measures in a Release build only";
  const ProgramOutcome r =
      run("report --no-page --seconds 3 --output '" + file("report") + "' --scene path1:n=100 --variant " +
          range + " --variant CPU1 --variant aCPU2+CPU2");
  if (r.output.find("libbenchmark-dev") != std::string::npos) GTEST_SKIP() << "without Google Benchmark";
  EXPECT_EQ(r.code, 1) << r.output;
  EXPECT_NE(r.output.find("catena report: " + range + " on path1/n:100: "), std::string::npos) << r.output;
  const std::string text = text_of(file("report") + "/run.json");
  for (const char* stage : {"build", "find", "whole"})
    EXPECT_NE(text.find("path1/n:100/aCPU2+CPU2/" + std::string(stage)), std::string::npos) << stage;
  EXPECT_NE(text.find("threw: stack slot 32 of 32"), std::string::npos);
}

/// A file system of its own, of a few pages.
TEST_F(ThrowingProgram, OnAFullDiskSaysSoAndLeavesNothing) {
  const std::string disk = file("disk");
  std::filesystem::create_directories(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=16k") != 0) GTEST_SKIP() << "may not mount a small disk";
  const ProgramOutcome full = run("detect coincident:n=200 --pairs '" + disk + "/p.csv'");
  EXPECT_EQ(full.code, 2);
  EXPECT_TRUE(full.output.ends_with("catena: cannot write " + disk + "/p.csv: No space left on device\n"))
      << full.output;
  EXPECT_TRUE(std::filesystem::is_empty(disk));
  const ProgramOutcome printed =
      shell("catena detect path1:n=10 --frame all --json >> '" + disk +
            "/log'; for k in 1 2 3; do catena list --json >> '" + disk + "/log'; done");
  EXPECT_EQ(printed.code, 2);
  EXPECT_TRUE(printed.output.ends_with("catena: cannot write the output: No space left on device\n"))
      << printed.output;
  EXPECT_EQ(umount(disk.c_str()), 0);
}

}  // namespace
}  // namespace catena

// What the program reads: files with and without radii, and standard input.
#include <gtest/gtest.h>

#include <string>

#include "catena/core/commands/test_program.h"

namespace catena {
namespace {

TEST_F(Program, ReadsFilesWithAndWithoutRadii) {
  expect_says("detect '" + examples + "Neuron.swc'", 0, {"spheres"});
  expect_says("detect '" + examples + "9_47-cubiclattice.txt' --closed --radius 0.5", 0, {"1 pair,"});
  expect_says("detect '" + examples + "9_47-cubiclattice.txt' --radius half-spacing --arc-window 1.57", 0,
              {"pairs"});
  expect_says("detect '" + examples + "rings.chain' --window 3", 0, {"spheres"});
}

TEST_F(Program, ReadsStandardInputAsWhatItIsSaidToBe) {
  expect_says("detect - --format vtp < " + examples + "branch.vtp", 0, {"7 spheres"});
  expect_refused("detect - < " + examples + "branch.vtp", "standard input: ");
  expect_refused("detect - --format vtp < /dev/null", "standard input: is empty");
  expect_refused("detect - --format vtp < /", "standard input: cannot be read: Is a directory");
  expect_refused("detect - --format vtp <&-", "standard input: cannot be read: it is closed");
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

}  // namespace
}  // namespace catena

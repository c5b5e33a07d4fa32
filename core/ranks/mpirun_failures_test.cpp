// Under mpirun the program ends with one line, on all ranks, whatever fails on whichever.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "catena/core/ranks/test_mpirun.h"
#include "catena/properties/testing/device_file.h"

namespace catena {
namespace {

TEST_F(Mpirun, EndsWithOneLineWhenTheInputIsWrong) {
  expect_one_line(run_ranks("detect /nowhere.chain"), "there is no such file");
  expect_one_line(run_ranks("detect coincident:n=60 --pair-limit 5"), "found 812 colliding pairs");
  expect_one_line(run_ranks("detect coincident:n=60 --pairs /nowhere/p.csv"), "cannot write /nowhere/p.csv");
  if (const auto full = properties::DeviceFile::full(file("full")))
    expect_one_line(run_ranks("detect coincident:n=60 --pairs '" + *full + "'"), "cannot write " + *full);
  // Where one rank alone refuses, and the other waits for it already.
  expect_one_line(
      run_ranks("detect rod:n=60 : -n 1 '" CATENA_PROGRAM "' detect rod:n=60 --variant Fastest", 1, "", 30),
      "catena: rank 1 of 2: there is no strategy 'Fastest'");
  expect_one_line(run_ranks("detect coincident:n=60 --variant CPU1/literal"), "ranks decide exactly");
  expect_one_line(run_ranks("detect path1:n=60,frame=3 --box 0.1,9,9"),
                  "path1:n=60,frame=3 frame 3: the box is 0.1 wide along x, less than twice the reach");
  const std::string table = "x,y,z,r\n0,0,0,1\n9,0,0,1\n1,0,0,1\n", in = write("in.csv", table);
  expect_one_line(run_ranks("detect " + in + " --pairs " + in), "is read, and would be lost");
  expect_one_line(run_ranks("detect yarn:n=50 --topology " + in + " --counts " + in),
                  "is read, and would be lost");
  EXPECT_EQ(text_of(file("in.csv")), table);
  expect_one_line(run_ranks("detect coincident:n=60 --depth"), "--depth and --margin are columns of --pairs");
  expect_one_line(run_ranks("list"), "ranks do not share the command 'list'");
  for (const char* const option : {"--tolerance 0.1", "--plan", "--no-omit exact"})
    expect_one_line(run_ranks("detect coincident:n=60 " + std::string(option)), "; leave out mpirun");
  expect_one_line(run_ranks("bench coincident:n=60 --plan"),
                  "there is no option --plan here; see mpirun -n 2 catena bench --help");
  // On a disk of few pages.
  const std::string disk = file("disk");
  std::filesystem::create_directories(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=16k") == 0) {
    const ProgramOutcome full = run_ranks("detect coincident:n=200 --pairs '" + disk + "/p.csv'");
    EXPECT_EQ(full.code, 2);
    EXPECT_NE(full.output.find(": cannot write " + disk + "/p.csv: No space left on device\n"),
              std::string::npos)
        << full.output;
    EXPECT_TRUE(std::filesystem::is_empty(disk));
    EXPECT_EQ(umount(disk.c_str()), 0);
  }
}

/// An interrupted run leaves the file that was there, and none of its own.
TEST_F(Mpirun, LeavesNoHalfFileWhenItIsInterrupted) {
  std::filesystem::create_directories(file("tables"));
  write("tables/pairs.csv", "old\n");
  const std::string folder = file("tables");
  const char* const as_root = geteuid() == 0 ? "--allow-run-as-root" : "";
  for (const char* const signal : {"TERM", "HUP"}) {
    const ProgramOutcome outcome = shell(fmt::format(
        "cd '{0}'; '{1}' --quiet --oversubscribe {2} -n 2 '" CATENA_PROGRAM
        "' detect coincident:n=8000,together=8000 --pairs pairs.csv > '{3}' 2>&1 & run=$!; "
        "for k in $(seq 600); do ls pairs.csv.*.unfinished > '{3}' 2>&1 && break; sleep .02; done; "
        "kill -{4} $run; wait $run; for k in $(seq 100); do ls pairs.csv.* > '{3}' 2>&1 || break; sleep .02; "
        "done; ls > '{3}'",
        folder, CATENA_MPIRUN, as_root, file("out"), signal));
    EXPECT_EQ(outcome.output, "pairs.csv\n") << signal;
    EXPECT_EQ(text_of(file("tables/pairs.csv")), "old\n") << signal;
  }
}

/// Whatever goes wrong on one rank, wherever: all end within seconds, with its words, and leave no file.
TEST_F(Mpirun, EndsAllRanksWhenOneFails) {
  std::filesystem::create_directories(file("tables"));
  // At every phase an error of one rank and too little memory of another; the two change places in turn.
  unsigned errs = 0;
  for (const std::string phase :
       {"read", "take_part", "order", "repartition", "build", "within", "across", "answers", "write"}) {
    for (const std::string kind : {"error", "memory"}) {
      const unsigned rank = kind == "error" ? errs : 2 - errs;
      const auto began = std::chrono::steady_clock::now();
      const ProgramOutcome r =
          run_ranks("detect yarn:n=2000 --order space --pairs '" + file("tables/p.csv") + "'", 3,
                    fmt::format("CATENA_RANK_FAULT={}:{}:{}", phase, rank, kind));
      EXPECT_EQ(r.code, 2) << phase << ' ' << rank << ' ' << kind << ": " << r.output;
      const std::string words =
          fmt::format("catena: rank {} of 3: {}", rank, kind == "error" ? "a fault" : "out of memory");
      EXPECT_NE(r.output.find(words), std::string::npos) << phase << ": " << r.output;
      EXPECT_EQ(r.output.find("catena:"), r.output.rfind("catena:")) << r.output;
      EXPECT_TRUE(std::filesystem::is_empty(file("tables"))) << phase;
      EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(60));
    }
    errs = 2 - errs;
  }
  // While rank 0 is deep in a search, and does not hear of it.
  const ProgramOutcome busy =
      run_ranks("detect rod:n=200 --pairs '" + file("tables/p.csv") + "'", 3,
                "CATENA_RANK_PATIENCE=500 CATENA_RANK_FAULT=build:0:busy,build:1:error,build:2:memory", 30);
  EXPECT_EQ(busy.code, 2) << busy.output;
  EXPECT_NE(busy.output.find("catena: rank 1 of 3: a fault"), std::string::npos) << busy.output;
  EXPECT_EQ(busy.output.find("catena:"), busy.output.rfind("catena:")) << busy.output;
  EXPECT_TRUE(std::filesystem::is_empty(file("tables")));
  const ProgramOutcome killed = run_ranks("detect yarn:n=2000", 3, "CATENA_RANK_FAULT=within:1:end");
  EXPECT_NE(killed.code, 0);
}

}  // namespace
}  // namespace catena

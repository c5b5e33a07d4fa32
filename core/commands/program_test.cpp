#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

/// The program as a user runs it: its exit codes, its one line for bad input, its files and its JSON.
namespace catena {
namespace {

struct Outcome {
  int code;
  std::string output;  ///< standard output, then standard error
};

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class Program : public testing::Test {
 protected:
  Program()
      : folder_(std::filesystem::temp_directory_path() / ("catena-program-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  Outcome run(const std::string& arguments) const {
    return shell("catena " + arguments + " > '" + file("out") + "'");
  }
  /// A line of the shell, in which the program is called catena.
  Outcome shell(const std::string& line) const {
    const std::string out = file("out"), err = file("err");
    std::ofstream(out).close();
    const std::string command =
        std::string("catena() { '") + CATENA_PROGRAM + "' \"$@\"; }; exec 2> '" + err + "'; " + line;
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out) + text_of(err)};
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  void expect_refused(const std::string& arguments, const std::string& because) const {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, 2) << arguments;
    EXPECT_NE(r.output.find(because), std::string::npos) << arguments << ": " << r.output;
    EXPECT_EQ(std::ranges::count(r.output, '\n'), 1) << arguments << ": " << r.output;
    EXPECT_TRUE(r.output.starts_with("catena: ")) << r.output;
  }
  void expect_says(const std::string& arguments, int code, const std::vector<std::string>& parts) const {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << arguments << ": " << r.output;
    for (const std::string& part : parts)
      EXPECT_NE(r.output.find(part), std::string::npos)
          << arguments << " does not say '" << part << "': " << r.output;
  }

 private:
  std::filesystem::path folder_;
};

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
  expect_refused("detect path1:n=10 --frame first", "must be a frame number from 0, or all");
  expect_refused("detect path1:n=10 --variant Fastest", "'Fastest'");
  expect_refused("detect path1:n=10 --any --counts-only", "--any");
  expect_refused("detect path1:n=10 --counts-only --pairs p.csv", "--counts-only");
  expect_refused("detect path1:n=10 --radius wide", "--radius wide");
  expect_refused("detect path1:n=10 --radius -1", "--radius -1");
  expect_refused("detect path1:n=10 --window 2 --arc-window 1", "excludes");
  expect_refused("detect path1:n=10 --window 0", "window");
  expect_refused("detect path1:n=3000 --variant bGPU2@host+CPU2", "aGPU2");
  expect_refused("detect coincident:n=200 --pair-limit 5", "5");
  expect_refused("detect path1:n=10 --pairs /nowhere/p.csv", "cannot write /nowhere/p.csv");
  expect_refused("verify path1:n=10 --variant None", "'None'");
  expect_refused("fuzz --scene-family none", "no family 'none'");
  expect_refused("fuzz --replay /nowhere.chain", "/nowhere.chain");
}

TEST_F(Program, ListsVariantsScenesAndReaders) {
  expect_says("list", 0, {"aCPU2+CPU2", "path1", ".swc", "subtree=384"});
  const auto list = nlohmann::json::parse(run("list --json").output);
  EXPECT_GE(list["variants"].size(), 40u);
  for (const auto& variant : list["variants"]) {
    for (const char* key : {"name", "arithmetic", "device", "unavailable", "stages", "exact", "peer"})
      EXPECT_TRUE(variant.contains(key)) << variant << " lacks " << key;
    EXPECT_EQ(variant["device"], variant["on_device"]) << variant;
  }
  EXPECT_GE(list["scenes"].size(), 20u);
  for (const auto& scene : list["scenes"]) EXPECT_FALSE(scene["parameters"].empty()) << scene["name"];
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

TEST_F(Program, WritesPairsAndCounts) {
  const std::string pairs = file("pairs.csv"), counts = file("counts.csv");
  expect_says("detect coincident:n=60 --pairs '" + pairs + "' --counts '" + counts + "'", 0, {"812 pairs"});
  const std::string pair_text = text_of(pairs), count_text = text_of(counts);
  EXPECT_TRUE(pair_text.starts_with("frame,i,j\n0,0,2\n")) << pair_text.substr(0, 40);
  EXPECT_EQ(std::ranges::count(pair_text, '\n'), 813);
  EXPECT_TRUE(count_text.starts_with("frame,sphere,count\n0,0,")) << count_text.substr(0, 40);
  EXPECT_EQ(std::ranges::count(count_text, '\n'), 61);
}

/// Of a name that is not a regular file, the thing stays, and gets the text.
TEST_F(Program, WritesThroughWhatIsNoRegularFile) {
  const std::string csv = "frame,sphere,count\n0,0,1\n0,1,0\n0,2,1\n",
                    scene = "detect coincident:n=3 --counts ";
  const Outcome both = run(scene + "/dev/stdout --any");
  EXPECT_EQ(both.code, 2) << "--any counts nothing";
  const Outcome printed = run(scene + "/dev/stdout");
  EXPECT_EQ(printed.code, 0);
  EXPECT_NE(printed.output.find(csv), std::string::npos) << printed.output;
  EXPECT_NE(printed.output.find("1 pairs, at most 1 a sphere"), std::string::npos) << printed.output;

  const std::string fifo = file("fifo"), read = file("read"), link = file("link");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(shell("cat '" + fifo + "' > '" + read + "' & catena " + scene + "'" + fifo + "'; wait").code, 0);
  EXPECT_TRUE(std::filesystem::is_fifo(fifo));
  EXPECT_EQ(text_of(read), csv);

  std::filesystem::create_symlink("read", link);
  expect_says(scene + "'" + link + "' --window 2", 0, {"0 pairs"});
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(text_of(read), "frame,sphere,count\n0,0,0\n0,1,0\n0,2,0\n");

  std::filesystem::create_symlink("/dev/full", file("full"));
  expect_says(scene + "'" + file("full") + "'", 2,
              {"cannot write " + file("full") + ": No space left on device"});
  EXPECT_TRUE(std::filesystem::is_symlink(file("full")));
}

TEST_F(Program, SaysWhenItsOutputIsNotWritten) {
  for (const std::string command :
       {"list", "list --json", "--help", "--version", "detect path1:n=10",
        "detect path1:n=10 --frame all --json", "verify path1:n=10 --variant CPU1", "fuzz --cases 3",
        "margins path1:n=10"}) {
    const Outcome full = shell("catena " + command + " > /dev/full");
    EXPECT_EQ(full.code, 2) << command;
    EXPECT_EQ(full.output, "catena: cannot write the output: No space left on device\n") << command;
  }
  const Outcome closed = shell("catena detect coincident:n=60 --pairs '" + file("p.csv") + "' >&-");
  EXPECT_EQ(closed.code, 2);
  EXPECT_EQ(closed.output, "catena: cannot write the output: Bad file descriptor\n");
  EXPECT_EQ(std::ranges::count(text_of(file("p.csv")), '\n'), 813) << "what is printed got into the table";
}

TEST_F(Program, EndsQuietlyWhenNobodyReadsOn) {
  const Outcome left = shell(
      "{ catena detect path1:n=3000 --frame all --json; echo $? >&2; } | head -c 1 > '" + file("out") + "'");
  EXPECT_EQ(left.output, "{2\n");
}

TEST_F(Program, LeavesNothingBehindWhenAFileCannotBeWrittenToItsEnd) {
  const std::string folder = file("tables");
  std::filesystem::create_directories(folder);
  const Outcome cut =
      shell("cd '" + folder + "'; ulimit -f 1; catena detect coincident:n=100 --pairs p --counts c");
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(cut.output.ends_with("catena: cannot write p: File too large\n")) << cut.output;
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(Program, ReadsFilesWithAndWithoutRadii) {
  expect_says("detect '" + examples + "Neuron.swc'", 0, {"spheres"});
  expect_says("detect '" + examples + "9_47-cubiclattice.txt' --closed --radius 0.5", 0, {"pairs"});
  expect_says("detect '" + examples + "9_47-cubiclattice.txt' --radius half-spacing --arc-window 1.57", 0,
              {"pairs"});
  expect_says("detect '" + examples + "rings.chain' --window 3", 0, {"spheres"});
}

TEST_F(Program, VerifiesByReferenceAndByCertificate) {
  expect_says("verify coincident:n=60 path1:n=200", 0, {"aCPU2+CPU2", "CPU1", "exact"});
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

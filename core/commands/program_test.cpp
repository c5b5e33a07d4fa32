#include <gtest/gtest.h>
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
    const std::string out = file("out"), err = file("err");
    const std::string command =
        std::string("'") + CATENA_PROGRAM + "' " + arguments + " > '" + out + "' 2> '" + err + "'";
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
  expect_says("--version", 0, {"."});
  expect_says("detect --help", 0, {"--variant", "--frame", "--pairs"});
}

TEST_F(Program, RefusesBadUsageInOneLine) {
  expect_refused("", "--help");
  expect_refused("nonsense", "--help");
  expect_refused("detect", "INPUT");
  expect_refused("detect nowhere", "no scene is named 'nowhere'");
  expect_refused("detect path1:x=1", "no parameter 'x'");
  expect_refused("detect path1:n=10 --frame 99", "there is no frame 99");
  expect_refused("detect path1:n=10 --frame first", "must be a frame number from 0, or all");
  expect_refused("detect path1:n=10 --variant Fastest", "'Fastest'");
  expect_refused("detect path1:n=10 --any --counts-only", "--any");
  expect_refused("detect path1:n=10 --counts-only --pairs p.csv", "--counts-only");
  expect_refused("detect path1:n=10 --radius wide", "--radius wide");
  expect_refused("detect path1:n=10 --radius -1", "--radius -1");
  expect_refused("detect path1:n=10 --window 2 --arc-window 1", "--help");
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

// The run file against its description, reports/run_file.md; and that a run goes on where it was interrupted.
#include "catena/reports/run_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "catena/core/commands/variant_json.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reports/journal.h"
#include "catena/reports/test_run_file.h"

namespace catena::reports {
namespace {

std::size_t decoded_size(const std::string& text) {
  EXPECT_EQ(text.size() % 4, 0u);
  return text.size() / 4 * 3 - (text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0);
}

/// The keys that run_file.md writes between braces after `section[]`.
std::set<std::string> described(const std::string& section) {
  std::ifstream file(CATENA_SOURCE_DIR "/reports/run_file.md");
  std::string all{std::istreambuf_iterator<char>(file), {}};
  auto at = all.find("\n  " + section + "[]");
  EXPECT_NE(at, std::string::npos) << section;
  at = all.find('{', at) + 1;
  std::set<std::string> keys;
  std::string key;
  int depth = 0;
  for (bool in_key = true; at < all.size(); ++at) {
    const char c = all[at];
    if (depth == 0 && (c == ',' || c == ':' || c == '}' || c == '(')) {
      if (in_key && !key.empty()) keys.insert(key);
      in_key = c == ',', key.clear();
      if (c == '}') break;
    } else if (in_key && (std::isalnum(static_cast<unsigned char>(c)) || c == '_')) {
      key += c;
    }
    if (std::string_view("([{").find(c) != std::string_view::npos) ++depth;
    if (depth > 0 && std::string_view(")]}").find(c) != std::string_view::npos) --depth;
  }
  return keys;
}

TEST_F(RunFile, HoldsWhatItsDescriptionSays) {
  const Json& own = small_run()["catena"];
  EXPECT_EQ(own["schema"], 1);
  EXPECT_EQ(own["profile"], "quick");
  EXPECT_EQ(own["command"], "catena report --quick");
  EXPECT_GT(own["seconds"], 0);
  for (const char* section : {"scenes", "counts", "wants", "savings", "regret", "animation", "coherence",
                              "viewer", "keyframes", "memory", "steps"}) {
    ASSERT_TRUE(own.contains(section)) << section;
    const auto keys = described(section);
    EXPECT_GE(keys.size(), section == std::string("keyframes") ? 2u : 3u) << section;
    for (const Json& row : own[section])
      for (const auto& [key, value] : row.items()) EXPECT_TRUE(keys.contains(key)) << section << '.' << key;
    std::set<std::string> given;
    for (const Json& row : own[section])
      for (const auto& [key, value] : row.items()) given.insert(key);
    EXPECT_EQ(given, keys) << section;
  }
  for (const char* section : {"stability", "work_precision", "tube_errors", "examine", "bandwidth"})
    EXPECT_FALSE(own[section].empty()) << section;
  for (const auto& [fact, value] : environment()) EXPECT_EQ(small_run()["context"][fact], value);
}

TEST_F(RunFile, NamesInputsAlikeEverywhere) {
  std::set<std::string> inputs;
  for (const Json& scene : small_run()["catena"]["scenes"]) inputs.insert(scene["input"]);
  EXPECT_EQ(inputs, (std::set<std::string>{"path1/n:300", "path1:frames=all/n:100",
                                           "melt.dump:radius=0.5,box=8x8x8/n:4"}));
  for (const Json& row : small_run()["benchmarks"]) {
    const std::string name = row["name"];
    EXPECT_TRUE(inputs.contains(name.substr(0, name.find('/', name.find("/n:") + 1)))) << name;
  }
  for (const Json& row : small_run()["catena"]["counts"]) EXPECT_TRUE(inputs.contains(row["input"])) << row;
}

/// Every name that stands under a key "variant", at any depth.
std::set<std::string> variants_named(const Json& json) {
  std::set<std::string> names;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object() && key == "variant") names.insert(value.get<std::string>());
    if (value.is_structured()) names.merge(variants_named(value));
  }
  return names;
}

TEST_F(RunFile, DescribesEveryVariantThatItNames) {
  const Json& variants = small_run()["catena"]["variants"];
  auto named = variants_named(small_run()["catena"]);
  for (const auto& v : small_profile().variants) named.insert(v.name);
  for (const Json& row : small_run()["benchmarks"]) {
    const std::string name = row["name"];  // SCENE/n:N/VARIANT/STAGE/manual_time
    const auto begin = name.find('/', name.find("/n:") + 1) + 1;
    const auto end = name.rfind('/', name.rfind("/manual_time") - 1);
    named.insert(name.substr(begin, end - begin));
  }
  std::set<std::string> described;
  for (const auto& [name, value] : variants.items()) {
    described.insert(name);
    EXPECT_EQ(value, to_json(StrategyRegistry::instance().describe(name))) << name;
  }
  EXPECT_EQ(described, named);
  EXPECT_GE(described.size(), 4u);
}

/// As the stiff rope, which is found by variants that the user may not have asked for.
TEST(Report, DescribesVariantsThatOnlyASectionNames) {
  const auto described = [](const char* name) { return StrategyRegistry::instance().describe(name); };
  const Json sections = Json::parse(R"({"motion": [{"variant": "aCPU2+CPU2/double", "step": 1}],
                                        "work_precision": {"points": [{"variant": "aGPU2@host(subtree=256)+CPU2"}]}})");
  const Json variants = described_variants({described("CPU1")}, sections);
  Json expected = Json::object();
  for (const char* name : {"CPU1", "aCPU2+CPU2/double", "aGPU2@host(subtree=256)+CPU2"})
    expected[name] = to_json(described(name));
  EXPECT_EQ(variants, expected);
}

TEST_F(RunFile, ViewsHaveTheNumbersOfTheirChains) {
  for (const Json& view : small_run()["catena"]["viewer"]) {
    const std::string input = view["input"];
    const auto n = std::stoul(input.substr(input.find("/n:") + 3));
    for (const Json& frame : view["frames"]) {
      EXPECT_EQ(decoded_size(frame["spheres"]), n * sizeof(Sphere)) << input;
      EXPECT_EQ(decoded_size(frame["pairs"]) % sizeof(Pair), 0u) << input;
    }
    EXPECT_EQ(view["strands"].size(), view["closed"].size());
    EXPECT_EQ(view["strands"].size(), input.starts_with("hair") ? 100u : 1u);
    std::size_t bounds = 0;
    for (const Json& level : view["levels"]) bounds += decoded_size(level["spheres"]) / sizeof(Sphere);
    EXPECT_EQ(bounds, 2 * n - 1) << input << ": a binary tree over n leaves";
    EXPECT_EQ(decoded_size(view["levels"][0]["spheres"]), n * sizeof(Sphere));
    EXPECT_EQ(view.contains("wrong"), input.starts_with("far")) << input;
  }
}

TEST_F(RunFile, SavingsGiveTheSameAnswer) {
  for (const Json& row : small_run()["catena"]["savings"]) {
    EXPECT_TRUE(row["identical"]) << row;
    EXPECT_EQ(row["with_ms"].size(), row["without_ms"].size());
    EXPECT_GE(row["with_ms"].size(), 3u);
  }
}

TEST_F(RunFile, IsWrittenWholeOrNotAtAll) {
  const std::string file = testing::TempDir() + "catena_run.json";
  write_run(small_run(), file);
  std::ifstream in(file);
  EXPECT_EQ(Json::parse(in), small_run());
  EXPECT_FALSE(std::filesystem::exists(file + ".unfinished"));
  std::filesystem::remove(file);
  EXPECT_THROW(write_run(small_run(), "/nowhere/run.json"), InputError);
}

TEST_F(RunFile, GoesOnWhereItWasInterrupted) {
  const std::string file = testing::TempDir() + "catena_resumed_" + std::to_string(getpid());
  Profile p = small_profile();
  p.inputs = {{"path1:n=100"}};
  Journal begun = Journal::begin(file, Json::object());
  p.stopping.most_samples = 1;
  const Json first = measure_run(p, "", begun);
  Journal resumed = Journal::resume(file);
  p.stopping.most_samples = 3;
  const Json whole = measure_run(p, "", resumed);
  resumed.remove();

  const std::size_t cases = first["benchmarks"].size();
  ASSERT_GT(cases, 5u);
  ASSERT_EQ(whole["benchmarks"].size(), 3 * cases);
  std::map<std::string, std::set<int>> rounds;
  for (std::size_t k = 0; k < whole["benchmarks"].size(); ++k) {
    const Json& row = whole["benchmarks"][k];
    if (k < cases) {
      EXPECT_EQ(row["real_time"], first["benchmarks"][k]["real_time"]);
    }
    EXPECT_EQ(row["repetitions"], 3);
    rounds[row["name"]].insert(row["repetition_index"].get<int>());
  }
  for (const auto& [name, taken] : rounds) EXPECT_EQ(taken, (std::set<int>{0, 1, 2})) << name;
  EXPECT_EQ(whole["catena"]["savings"], first["catena"]["savings"]) << "times that were measured once";
  EXPECT_GT(whole["catena"]["seconds"], first["catena"]["seconds"].get<double>() / 2);
  EXPECT_EQ(whole["catena"]["stopping"]["rounds"], 3);
}

/// The limit holds for the run, however often it is interrupted.
TEST_F(RunFile, CountsTheTimeOfTheRowsBeforeAnInterrupt) {
  const std::string file = testing::TempDir() + "catena_late_" + std::to_string(getpid());
  Profile p;
  p.inputs = {{"path1:n=50"}};
  p.variants = {StrategyRegistry::instance().describe("CPU1")};
  p.stopping = {.seconds = 0.3, .share = 0, .most_samples = 1};
  p.whole_seconds = 0;
  Journal begun = Journal::begin(file, Json::object());
  measure_run(p, "", begun);
  const Json rows = Journal::resume(file).rows();
  begun.remove();
  p.stopping.most_samples = 100'000;
  for (const double seconds : {0.0, 1000.0}) {
    {
      Journal journal = Journal::begin(file, Json::object());
      for (const Json& row : rows) journal.keep_row(row, seconds);
    }
    Journal resumed = Journal::resume(file);
    EXPECT_EQ(measure_run(p, "", resumed)["benchmarks"].size() == rows.size(), seconds > 0);
    resumed.remove();
  }
}

TEST_F(RunFile, NothingToMeasureIsSaid) {
  Profile p = small_profile();
  p.filter = "no_such_scene";
  EXPECT_THROW(measure_run(p, ""), InputError);
}

TEST(Report, RefusesABuildThatIsNotRelease) {
  if (environment().at("build type") == "Release") GTEST_SKIP() << "this is a Release build";
  EXPECT_THROW(measure_run(small_profile(), ""), InputError);
}

}  // namespace
}  // namespace catena::reports

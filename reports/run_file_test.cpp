#include "catena/reports/run_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "catena/bench/regret/regret.h"
#include "catena/bench/timing/cases.h"
#include "catena/bench/tube/tube.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/commands/variant_json.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/reports/base64.h"
#include "catena/reports/section.h"

/// The run file against its description, reports/run_file.md.
namespace catena::reports {
namespace {

using Json = nlohmann::ordered_json;

/// Every section, small.
Profile small_profile() {
  Profile p = profile_named("quick");
  std::erase_if(p.variants, [](const VariantInfo& v) {
    return !std::set<std::string>{"CPU1",       "CPU1/literal", "aCPU2+CPU2", "aCPU2+CPU2/literal",
                                  "aCPU2+Dual", "Hybrid",       "auto"}
                .contains(v.name);
  });
  bench::WorkloadSpec in_box{CATENA_SOURCE_DIR "/core/readers/examples/melt.dump"};  // a box, two frames
  in_box.options.radius = 0.5f;
  p.inputs = {{"path1:n=300"}, {"path1:n=100", true}, in_box};
  p.stopping = {.seconds = 60, .share = 0, .most_samples = 2, .least_ms = 0.01, .seed = 5};
  p.section_seconds = 0.01;
  p.section_rounds = 3;
  p.stability_n = 200;  // the rope diverges when it is much shorter
  p.tube_spacings = {1};
  p.motion_steps.clear();
  p.examine_settings = {"n=200"};
  p.shown = {{"path1:n=200", true}, {"far:n=500,exponent=22"}, {"hair:n=200"}};
  p.wants_inputs = p.coherent_inputs = {bench::WorkloadSpec{"path1:n=200"}, in_box};
  p.regret_inputs = {bench::WorkloadSpec{"path1:n=16"}, bench::WorkloadSpec{"yarn:n=300"}, in_box};
  p.short_chains = {10, 100};
  p.animation_input = {"path1:n=200"};
  p.animation_step = 10;
  p.keyframe_sizes = {200};
  p.copy_bytes = 1 << 20;
  p.rank_chains = {{"yarn:n=1000", 8}, {"hair:n=1000", 4}};
  return p;
}

bool measures() {
  if (environment().at("build type") != "Release") return false;
  try {
    bench::measure_in_rounds({}, {});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

const Json& small_run() {
  static const Json run = measure_run(small_profile(), "catena report --quick");
  return run;
}

class RunFile : public testing::Test {
 protected:
  void SetUp() override {
    if (!measures()) GTEST_SKIP() << "measures in a Release build with Google Benchmark only";
  }
};

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

TEST_F(RunFile, NothingToMeasureIsSaid) {
  Profile p = small_profile();
  p.filter = "no_such_scene";
  EXPECT_THROW(measure_run(p, ""), InputError);
}

TEST(Report, RefusesABuildThatIsNotRelease) {
  if (environment().at("build type") == "Release") GTEST_SKIP() << "this is a Release build";
  EXPECT_THROW(measure_run(small_profile(), ""), InputError);
}

TEST(Report, PaperMeasuresThePapersTables) {
  std::ifstream file(CATENA_SOURCE_DIR "/reports/catena_report/paper_tables.json");
  const Json tables = Json::parse(file);
  std::vector<std::string> expected, planned;
  for (const char* path : {"path1", "path2"})
    for (const std::uint32_t n : tables["n"])
      expected.push_back(std::string(path) + ":n=" + std::to_string(n));
  for (const auto& input : profile_named("paper").inputs) {
    EXPECT_TRUE(input.all_frames);
    planned.push_back(input.input);
  }
  EXPECT_EQ(planned, expected);
  for (const char* profile : {"paper", "full"})
    EXPECT_EQ(Json(profile_named(profile).keyframe_sizes), tables["n"]) << profile;
  // Each of its ways once in either arithmetic, on a device or as the host does it.
  std::multiset<std::string> measured, ways;
  for (const VariantInfo& v : profile_named("paper").variants) {
    std::string name = v.name;
    for (auto at = name.find("@host"); at != std::string::npos; at = name.find("@host")) name.erase(at, 5);
    measured.insert(name);
  }
  for (const std::string way : {"GPU1", "aCPU2+CPU2", "aGPU2+GPU2", "aGPU2+GPUv2"})
    for (const char* arithmetic : {"", "/literal"}) ways.insert(way + arithmetic);
  EXPECT_EQ(measured, ways);
}

/// The stages and variants of each, and scenes for all of what auto may choose.
TEST(Report, ProfilesMeasureWhatTheyAreFor) {
  const auto has = [](const Profile& p, const std::string& part) {
    const auto cases = bench::filtered(bench::cases(p.inputs, p.variants, p.most_all_pairs), p.filter);
    return std::ranges::any_of(
        cases, [&](const bench::Case& c) { return c.name().find(part) != std::string::npos; });
  };
  const Profile quick = profile_named("quick"), full = profile_named("full"), paper = profile_named("paper");
  for (const auto& [name, p] : {std::pair("quick", &quick), {"full", &full}, {"paper", &paper}}) {
    EXPECT_EQ(p->name, name);
    for (const VariantInfo& v : p->variants) EXPECT_FALSE(v.unavailable) << v.name;
    std::vector<std::string> exact, all_exact;
    for (const VariantInfo& v : exact_variants(*p)) exact.push_back(v.name);
    for (const VariantInfo& v : p->variants)
      if (v.exact) all_exact.push_back(v.name);
    EXPECT_EQ(exact, all_exact);
    EXPECT_LT(exact.size(), p->variants.size());
    EXPECT_EQ(has(*p, "/whole"), p != &paper) << name << ": the tables have construction and traversal";
    EXPECT_EQ(has(*p, "/double/"), p == &full) << name << ": of the error only";
    EXPECT_TRUE(p == &paper || has(*p, "path1/n:10000/CPU1/")) << name << ": the paper's claim";
  }
  for (const auto& [p, n] : {std::pair(&quick, 1000u), {&full, 1000u}, {&full, 30'000u}, {&full, 1'000'000u}})
    for (const bench::WorkloadSpec& scene : bench::all_scenes(n))
      EXPECT_TRUE(std::ranges::count(p->regret_inputs, scene.input, &bench::WorkloadSpec::input))
          << scene.input;
  EXPECT_EQ(full.whole_seconds, 0) << "as long as it takes";
}

TEST(Report, EveryProfileNamesTubesThatThereAre) {
  for (const char* profile : {"quick", "full", "paper"}) {
    for (const std::string& tube : profile_named(profile).tubes)
      EXPECT_EQ(bench::tubes_named({tube}).size(), 1u) << profile;
  }
}

TEST(Report, Base64IsThatOfTheStandard) {
  const auto of = [](const std::string& text) { return base64(std::span<const char>(text)); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

/// The command report with these options. Throws InputError for what it does not take.
std::unique_ptr<Command> with_options(const std::string& arguments) {
  const auto commands = CommandRegistry::instance().commands();
  auto command = std::ranges::find(commands, "report", &CommandInfo::name)->make();
  std::istringstream words(arguments);
  parse_options({std::istream_iterator<std::string>(words), {}},
                [&](OptionParser& app) { command->configure(app); });
  return command;
}

int report(const std::string& arguments) { return with_options(arguments)->run(); }

/// The files of a folder, but for the list of its reports.
std::set<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  names.erase(".catena-report");
  return names;
}

TEST_F(RunFile, KeepsWhatWasMeasuredAtCtrlC) {
  const std::filesystem::path folder = testing::TempDir() + "catena_interrupted_" + std::to_string(getpid());
  std::filesystem::remove_all(folder);
  const pid_t child = fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stderr);
    report("--scene path1:n=100 --variant aCPU2+CPU2 --seconds 3 --repetitions 9999 --no-page --output " +
           folder.string());
    _exit(0);
  }
  const auto rows = [&] {
    std::ifstream in(folder / "run.journal");
    std::size_t found = 0;
    for (std::string line; std::getline(in, line);) found += line.starts_with(R"({"row")");
    return found;
  };
  for (int wait = 0; wait < 3000 && rows() < 20; ++wait) usleep(10'000);
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) << status;
  EXPECT_EQ(files_in(folder), std::set<std::string>{"run.journal"});
  const std::size_t kept = rows();
  ASSERT_GE(kept, 20u);

  EXPECT_THROW(report("--scene path1:n=100 --no-page --output " + folder.string()), InputError)
      << "would lose it";
  EXPECT_THROW(with_options("--resume --seed 3 --output " + folder.string()), InputError)
      << "its options are known";
  EXPECT_EQ(report("--resume --output " + folder.string()), 0);
  EXPECT_EQ(files_in(folder), std::set<std::string>{"run.json"});
  std::ifstream in(folder / "run.json");
  const Json run = Json::parse(in);
  EXPECT_GE(run["benchmarks"].size(), kept);
  EXPECT_NE(run["catena"]["command"].get<std::string>().find("--repetitions 9999"), std::string::npos);
  EXPECT_THROW(report("--resume --output " + folder.string()), InputError) << "nothing is left to resume";
  std::filesystem::remove_all(folder);
}

TEST_F(RunFile, HoldsAsManyRepetitionsAsAreAskedFor) {
  const std::filesystem::path folder = testing::TempDir() + "catena_repetitions_" + std::to_string(getpid());
  EXPECT_EQ(
      report("--scene path1:n=50 --variant CPU1 --repetitions 14 --no-page --output " + folder.string()), 0);
  std::ifstream in(folder / "run.json");
  const Json run = Json::parse(in);
  std::map<std::string, int> repetitions;
  for (const Json& row : run["benchmarks"]) {
    ++repetitions[row["name"]];
    for (const char* key : {"least_ms", "load_one_ms", "load_all_ms"}) EXPECT_GT(row[key], 0) << key;
    EXPECT_LE(row["least_ms"], row["real_time"].get<double>() * (1 + 1e-9));
  }
  EXPECT_EQ(repetitions.size(), 2u);
  EXPECT_FALSE(run["catena"].contains("judged")) << "what is not about the scene asked for";
  for (const auto& [name, times] : repetitions) EXPECT_EQ(times, 14) << name;
  std::filesystem::remove_all(folder);
}

TEST(Report, RefusesWhatMakesNoSense) {
  EXPECT_THROW(report("--variant Nope"), InputError);
  EXPECT_THROW(report("--scene nope:n=3 --no-page"), InputError);
  EXPECT_THROW(report("--benchmark_filter ( --no-page"), InputError);
  EXPECT_THROW(with_options("--quick --full"), InputError);
  EXPECT_THROW(with_options("--seconds -1"), InputError);
  EXPECT_THROW(with_options("--repetitions 0"), InputError);
  EXPECT_THROW(with_options("--resume --full"), InputError);
  EXPECT_THROW(with_options("--compare only_one.json"), InputError);
  EXPECT_THROW(profile_named("slow"), InputError);
}

}  // namespace
}  // namespace catena::reports

// What each profile of the report measures: its scenes, stages and variants.
#include "catena/reports/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/regret/regret.h"
#include "catena/bench/timing/cases.h"
#include "catena/bench/tube/tube.h"

namespace catena::reports {
namespace {

using Json = nlohmann::ordered_json;

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
    for (const char* stage : {"/whole", "/update"})
      EXPECT_EQ(has(*p, stage), p != &paper) << name << ": the tables have construction and traversal";
    EXPECT_EQ(has(*p, "/double/"), p == &full) << name << ": of the error only";
    EXPECT_TRUE(p == &paper || has(*p, "path1/n:10000/CPU1/")) << name << ": the paper's claim";
  }
  for (const auto& [p, n] : {std::pair(&quick, 1000u), {&full, 1000u}, {&full, 30'000u}, {&full, 1'000'000u}})
    for (const bench::WorkloadSpec& scene : bench::all_scenes(n))
      EXPECT_TRUE(std::ranges::count(p->regret_inputs, scene.input, &bench::WorkloadSpec::input))
          << scene.input;
  for (const bench::WorkloadSpec& scene : bench::all_scenes(10'000))
    EXPECT_TRUE(std::ranges::count(full.planned_inputs, scene.input)) << scene.input << " has no savings";
  EXPECT_EQ(full.whole_seconds, 0) << "as long as it takes";
}

TEST(Report, EveryProfileNamesTubesThatThereAre) {
  for (const char* profile : {"quick", "full", "paper"}) {
    for (const std::string& tube : profile_named(profile).tubes)
      EXPECT_EQ(bench::tubes_named({tube}).size(), 1u) << profile;
  }
}

}  // namespace
}  // namespace catena::reports

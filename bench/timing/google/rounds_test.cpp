#include "catena/bench/timing/google/rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "catena/bench/timing/test_times_told.h"
#include "catena/core/error.h"
#include "catena/core/strategy/timings.h"

namespace catena::bench {
namespace {

std::vector<VariantInfo> named(const std::set<std::string>& names) {
  auto all = StrategyRegistry::instance().variants();
  std::erase_if(all, [&](const VariantInfo& v) { return !names.contains(v.name); });
  return all;
}

std::vector<Case> some_cases() {
  return cases({{"path1:n=300"}, {"yarn:n=200"}},
               named({"CPU1", "CPU1/literal", "aCPU2+CPU2", "aCPU2+Dual", "aGPU2@host+GPU2@host"}));
}

class RoundsTest : public testing::Test {
 protected:
  /// Skips where this program was built without Google Benchmark.
  Rounds measured(const std::vector<Case>& all, const Stopping& stopping) {
    try {
      return measure_in_rounds(all, stopping);
    } catch (const InputError& absent) {
      EXPECT_NE(std::string(absent.what()).find("libbenchmark-dev"), std::string::npos);
      return {};
    }
  }
};

/// SCENE/n:N/VARIANT of a row.
std::string unit_of(const nlohmann::ordered_json& row) {
  std::string name = row["name"];
  for (const char* stage : {"/build/", "/update/", "/find/", "/whole/"})
    if (const auto at = name.find(stage); at != std::string::npos) name.resize(at);
  return name;
}

TEST_F(RoundsTest, TakeOneSampleOfEveryCaseInAFreshRandomOrder) {
  const auto all = some_cases();
  const auto result =
      measured(all, {.seconds = 60, .share = 0, .most_samples = 7, .least_ms = 0.01, .seed = 3});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  EXPECT_EQ(result.rounds, 7u);
  EXPECT_EQ(result.cases, all.size());
  EXPECT_EQ(result.narrow, 0u);
  ASSERT_EQ(result.benchmarks.size(), 7 * all.size());

  std::map<std::string, std::uint64_t> pairs_of;  // by SCENE/n:N
  for (const Case& c : all) pairs_of[c.facts.label] = workload(c.spec)->exact.front().pair_count;
  std::set<std::vector<std::string>> orders;
  for (std::size_t round = 0; round < 7; ++round) {
    std::set<std::string> names;
    std::vector<std::string> order;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto& row = result.benchmarks[round * all.size() + k];
      EXPECT_EQ(row["repetition_index"], round);
      EXPECT_EQ(row["repetitions"], 7);
      EXPECT_EQ(row["name"], all[row["family_index"].get<std::size_t>()].name() + "/manual_time");
      EXPECT_GT(row["load_one_ms"].get<double>(), 0) << row["name"];
      EXPECT_GT(row["load_all_ms"].get<double>(), 0) << row["name"];
      EXPECT_EQ(row["run_type"], "iteration");
      EXPECT_GT(row["real_time"].get<double>(), 0) << row["name"];
      EXPECT_LE(row["least_ms"].get<double>(), row["real_time"].get<double>() * (1 + 1e-9)) << row["name"];
      EXPECT_EQ(row["pairs"], pairs_of.at(unit_of(row).substr(0, unit_of(row).find('/', 7)))) << row["name"];
      names.insert(row["name"]);
      if (order.empty() || order.back() != unit_of(row)) order.push_back(unit_of(row));
    }
    EXPECT_EQ(names.size(), all.size());
    EXPECT_EQ(order.size(), 10u) << "the stages of a variant on an input follow each other";
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 7u);
  for (const Case& c : all)
    EXPECT_TRUE(std::ranges::any_of(result.benchmarks, [&](const auto& row) {
      return row["name"] == c.name() + "/manual_time";
    })) << c.name();
}

TEST_F(RoundsTest, StopWhenTheIntervalIsNarrow) {
  const auto all = some_cases();
  const auto result = measured(all, {.seconds = 60, .share = 1e9, .most_samples = 50, .least_ms = 0.01});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  EXPECT_EQ(result.rounds, 6u) << "six samples are the fewest that bound a median";
  EXPECT_EQ(result.narrow, all.size());
}

TEST_F(RoundsTest, RespectTheTimeLimit) {
  const auto all =
      cases({{"path1:n=3000"}, {"yarn:n=2000"}, {"path2:n=3000"}}, named({"aCPU2+CPU2", "aCPU2+Dual"}));
  const Stopwatch watch;
  const auto result = measured(all, {.seconds = 0.3, .share = 0, .most_samples = 1'000'000, .least_ms = 1});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  EXPECT_LT(watch.ms(), 20'000);  // a sample that has begun is finished, also by a sanitizer
  EXPECT_EQ(result.cases + result.not_reached.size(), all.size());
}

TEST_F(RoundsTest, SayWhatIsNotReached) {
  const auto all = some_cases();
  const auto result = measured(all, {.seconds = 0, .share = 0});
  if (result.benchmarks.is_null() && result.not_reached.empty()) GTEST_SKIP() << "without Google Benchmark";
  EXPECT_EQ(result.not_reached.size(), all.size());
  EXPECT_TRUE(result.benchmarks.empty());
}

TEST_F(RoundsTest, ARefusedVariantIsAnErrorWithItsReason) {
  const auto all = cases({{"path1:n=2000"}}, named({"bGPU2@host+CPU2"}));
  const auto result = measured(all, {.seconds = 60, .most_samples = 3, .least_ms = 0.01});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  ASSERT_EQ(result.benchmarks.size(), all.size());
  for (const auto& row : result.benchmarks) {
    EXPECT_TRUE(row["error_occurred"]);
    EXPECT_EQ(row["repetitions"], 1);
    EXPECT_FALSE(row.contains("at_fault")) << "a refusal is no fault";
    EXPECT_NE(row["error_message"].get<std::string>().find("1536"), std::string::npos);
  }
}

TEST_F(RoundsTest, AVariantThatThrowsIsAtFaultAlsoAfterAnInterruption) {
  const auto all =
      cases({{"path1:n=50"}}, {StrategyRegistry::instance().describe("mutant:throws-past-32-spheres")});
  const Stopping stopping{.seconds = 60, .most_samples = 3, .least_ms = 0.01};
  const auto result = measured(all, stopping);
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  ASSERT_EQ(result.benchmarks.size(), all.size());
  for (const auto& row : result.benchmarks) EXPECT_TRUE(row.value("at_fault", false)) << row;
  ASSERT_EQ(result.faults.size(), 1u);
  EXPECT_TRUE(result.faults[0].starts_with("mutant:throws-past-32-spheres on path1/n:50: "))
      << result.faults[0];
  EXPECT_EQ(measure_in_rounds(all, stopping, {}, result.benchmarks).faults, result.faults);
}

/// What a variant gets wrong stands beside its times, and that it got nothing wrong, too.
TEST_F(RoundsTest, TellWhatAVariantGetsWrong) {
  const auto all = cases({{"grazing:n=400,margin=1e-8"}, {"far:n=500,exponent=24"}},
                         named({"aCPU2+CPU2", "aCPU2+CPU2/literal"}));
  const auto result = measured(all, {.seconds = 60, .share = 0, .most_samples = 1, .least_ms = 0.01});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  ASSERT_EQ(result.benchmarks.size(), all.size());
  for (const auto& row : result.benchmarks) {
    const std::string name = row["name"];
    const bool rounded = name.find("/literal/") != std::string::npos, grazing = name.starts_with("grazing");
    EXPECT_EQ(row["missing"] > 0, rounded && !grazing) << name;
    EXPECT_EQ(row["invented"] > 0, rounded && grazing) << name;
  }
}

TEST_F(RoundsTest, GoOnAfterAnInterruptionWhereTheyWere) {
  auto all = cases({{"path1:n=2000"}}, named({"aCPU2+Dual", "bGPU2@host+CPU2"}));
  Stopping stopping{.seconds = 60, .share = 0, .most_samples = 2, .least_ms = 0.01};
  auto before = measured(all, stopping);
  if (before.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  for (auto& row : before.benchmarks)
    if (row.contains("iterations")) row["iterations"] = 3;  // on a quicker machine it may have been more
  stopping.most_samples = 5;
  auto rows = before.benchmarks;
  rows.insert(rows.begin(), rows[0]), rows[0]["name"] = "of a case that is gone";
  std::vector<nlohmann::ordered_json> taken;
  const auto after = measure_in_rounds(
      all, stopping, [&](const auto& row) { taken.push_back(row); }, rows);
  EXPECT_EQ(after.benchmarks.size(), before.benchmarks.size() + taken.size()) << "each is taken as it comes";
  for (std::size_t k = 0; k < taken.size(); ++k)
    EXPECT_EQ(taken[k]["name"], after.benchmarks[before.benchmarks.size() + k]["name"]);
  EXPECT_EQ(after.rounds, 5u);
  EXPECT_TRUE(after.not_reached.empty());
  for (const Case& c : all) {
    std::set<std::int64_t> iterations;
    std::vector<double> times, earlier;
    std::size_t refused = 0;
    for (const auto& row : after.benchmarks) {
      if (row["name"] != c.name() + "/manual_time") continue;
      if (row.value("error_occurred", false)) {
        ++refused;
        continue;
      }
      EXPECT_EQ(row["repetition_index"], times.size());
      EXPECT_EQ(row["repetitions"], 5);
      times.push_back(row["real_time"]);
      iterations.insert(row["iterations"].get<std::int64_t>());
    }
    for (const auto& row : before.benchmarks)
      if (row["name"] == c.name() + "/manual_time" && !row.value("error_occurred", false))
        earlier.push_back(row["real_time"]);
    const bool answers = c.variant.name == "aCPU2+Dual";
    EXPECT_EQ(times.size(), answers ? 5u : 0u) << c.name();
    EXPECT_EQ(refused, answers ? 0u : 1u) << c.name() << ": asked again";
    EXPECT_EQ(iterations, answers ? std::set<std::int64_t>{3} : std::set<std::int64_t>{}) << c.name();
    EXPECT_TRUE(std::ranges::equal(std::span(times).first(std::min(times.size(), earlier.size())), earlier));
  }
}

TEST_F(RoundsTest, ASampleOfAnAnimationGoesThroughEveryFrame) {
  const auto all = cases({{"path1:n=200", true}}, named({"aCPU2+CPU2"}));
  const auto result = measured(all, {.seconds = 60, .most_samples = 2, .least_ms = 0.01});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  ASSERT_EQ(result.benchmarks.size(), 8u);
  for (const auto& row : result.benchmarks) {
    EXPECT_EQ(row["iterations"], 56);
    EXPECT_TRUE(row["name"].get<std::string>().starts_with("path1:frames=all/n:200/aCPU2+CPU2/"));
  }
}

TEST_F(RoundsTest, GiveEachStageItsOwnTime) {
  const auto result = measured(cases({{"path1:n=50"}}, {TimesTold::info()}),
                               {.seconds = 60, .share = 0, .most_samples = 3, .least_ms = 0.01});
  if (result.benchmarks.is_null()) GTEST_SKIP() << "without Google Benchmark";
  const std::map<std::string, double> told{
      {"build", TimesTold::build_ms}, {"update", TimesTold::update_ms}, {"find", TimesTold::find_ms}};
  std::map<std::string, int> rows;
  for (const auto& row : result.benchmarks) {
    const std::string name = row["name"], prefix = "path1/n:50/TimesTold/", suffix = "/manual_time";
    ASSERT_TRUE(name.starts_with(prefix) && name.ends_with(suffix)) << name;
    const auto stage = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    ++rows[stage];
    EXPECT_EQ(row["time_unit"], "ms");
    const double ms = row["real_time"];
    if (stage == "whole") {
      EXPECT_GE(ms, TimesTold::slept_ms);
    } else {
      EXPECT_NEAR(ms, told.at(stage), 1e-6) << name;
      EXPECT_EQ(row["transfer_ms"], TimesTold::transfer_ms) << name;
    }
  }
  EXPECT_EQ(rows, (std::map<std::string, int>{{"build", 3}, {"update", 3}, {"find", 3}, {"whole", 3}}));
}

}  // namespace
}  // namespace catena::bench

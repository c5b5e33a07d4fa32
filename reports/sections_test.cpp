#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "catena/bench/counts/count_work.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/reports/test_sections.h"

/// What stands in each section of a run file, against what it is said to be. That the keys are those of
/// run_file.md run_file_test.cpp looks after.
namespace catena::reports {
namespace {

using namespace std::chrono_literals;

TEST(Sections, ComeInTheOrderOfTheirNames) {
  const auto all = sections();
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, &Section::name));
  EXPECT_GE(all.size(), 15u);
}

TEST(Sections, OfAnAnimationHaveEachFrameOfEveryVariant) {
  Profile p = profile_of({"CPU1", "aCPU2+CPU2", "aCPU2+CPU2/literal", "ChainTree"});
  p.animation_input = {"path1:n=300"};
  p.animation_step = 5;
  const auto animation = open_input("path1:n=300").animation;
  const Json rows = section("animation", p);
  ASSERT_EQ(rows.size(), 2u) << "exact, and no comparison of all pairs";
  for (const Json& row : rows) {
    EXPECT_EQ(row["input"], "path1/n:300");
    ASSERT_EQ(row["frames"].size(), 12u);
    for (std::size_t k = 0; k < row["frames"].size(); ++k) {
      const Json& frame = row["frames"][k];
      const auto f = static_cast<std::uint32_t>(5 * k);
      EXPECT_EQ(frame["frame"], f);
      EXPECT_EQ(frame["pairs"], exact_pairs("path1:n=300", f));
      const Chain now = animation->frame(f), before = animation->frame(f < 5 ? 0 : f - 5);
      std::uint32_t moved = 0;
      for (std::uint32_t i = 0; i < now.size(); ++i) moved += now[i] != before[i];
      EXPECT_EQ(frame["moved"], moved) << f;
    }
  }
  // Frames whose boxes differ: only in the first the ends touch through a face. One sphere moves, and rests.
  const TestFile file("boxes.xyz", in_boxes({"8", "20", "20"}));
  p.animation_input = {file.path().string()};
  p.animation_input.options.radius = 1;
  p.animation_step = 1;
  for (const Json& row : section("animation", p)) {
    ASSERT_EQ(row["frames"].size(), 3u);
    for (std::uint32_t f = 0; f < 3; ++f) {
      EXPECT_EQ(row["frames"][f]["pairs"], f == 0 ? 1 : 0) << f;
      EXPECT_EQ(row["frames"][f]["moved"], f == 1 ? 1 : 0) << f;
      EXPECT_NE(row["frames"][f]["update_ms"], row["frames"][f]["find_ms"]);
    }
  }
  p.animation_input = {};
  EXPECT_TRUE(section("animation", p).empty());
}

/// The work is of the chain itself, as `catena` counts it, and once a variant.
TEST(Sections, OfCountsHaveEachVariantOnce) {
  Profile p = profile_of({"CPU1", "aCPU2+CPU2", "aCPU2+Dual"});
  p.inputs = {{"path1:n=300"}, in_box()};
  const Json rows = section("counts", p);
  ASSERT_EQ(rows.size(), 3u) << "none of the images in a box";
  const Chain chain = open_input("path1:n=300").animation->frame(28);
  for (const Json& row : rows) {
    const auto work =
        bench::count_work(StrategyRegistry::instance().describe(row["variant"].get<std::string>()), chain);
    EXPECT_EQ(row["pair_tests"], work->pair_tests);
    EXPECT_EQ(row["node_visits"], work->node_visits);
    EXPECT_EQ(row["bytes"], work->bytes);
  }
}

/// CPU1 to whom a build is dear and an update is not. Hidden, so that no other test meets it.
class DearBuild final : public Variant {
 public:
  void build(const Chain& chain) override { all_pairs_->build(chain), std::this_thread::sleep_for(3ms); }
  void update(const Chain& chain, const Moved&) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    all_pairs_->find(chain, request, found);
  }
  Timings timings() const override { return {}; }

 private:
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
};

const test::RegisterHidden<DearBuild> dear_build{{.name = "DearBuild", .summary = "dear"}};

TEST(Sections, OfCoherenceTellAnUpdateFromABuild) {
  Profile p = profile_of({"CPU1", "DearBuild"});
  const TestFile file("boxes.xyz", in_boxes({"8", "20", "20"}));
  p.coherent_inputs = {{"path1:n=100"}, {file.path().string()}};
  p.coherent_inputs[1].options.radius = 1;
  const Json rows = section("coherence", p);
  ASSERT_EQ(rows.size(), 2u) << "not of all pairs";
  for (const Json& row : rows) {
    EXPECT_EQ(row["variant"], "DearBuild");
    for (const double ms : row["rebuild_ms"]) EXPECT_GE(ms, 3);
  }
  EXPECT_LT(std::ranges::min(rows[0]["update_ms"].get<std::vector<double>>()), 3);
  EXPECT_GE(std::ranges::min(rows[1]["update_ms"].get<std::vector<double>>()), 3)
      << "of other images, in a box";
}

/// Looks whether a chain that it is updated to is another than that it stands on.
class Watchful final : public Variant {
 public:
  void build(const Chain& chain) override { stands_on(chain); }
  void update(const Chain& chain, const Moved&) override {
    const std::vector<Sphere> before = spheres_;
    stands_on(chain);
    ++updates, unmoved += spheres_ == before;
  }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    all_pairs_->find(chain, request, found);
  }
  Timings timings() const override { return {}; }
  static inline int updates = 0, unmoved = 0;

 private:
  void stands_on(const Chain& chain) {
    spheres_.assign(chain.spheres().begin(), chain.spheres().end());
    all_pairs_->build(chain);
  }
  std::vector<Sphere> spheres_;
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
};

const test::RegisterHidden<Watchful> watchful{{.name = "Watchful", .summary = "looks what moved"}};

/// In every round: an update to the frame that stands is another's time.
TEST(Sections, OfCoherenceUpdateToAnotherFrame) {
  Profile p = profile_of({"Watchful"});
  p.coherent_inputs = {{"path1:n=100"}};
  Watchful::updates = Watchful::unmoved = 0;
  const Json rows = section("coherence", p);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_GE(rows[0]["update_ms"].size(), 3u);
  EXPECT_GE(Watchful::updates, 3);
  EXPECT_LE(Watchful::unmoved, 1) << "back to what was built, where that was no round's yet";
}

TEST(Sections, OfStepsHaveWhatASearchCounted) {
  Profile p = profile_of({"Hybrid", "CPU1"});
  p.inputs = {{"yarn:n=1000"}};
  const Json rows = section("steps", p);
  ASSERT_EQ(rows.size(), 1u) << "CPU1 counts no steps";
  const auto variant = StrategyRegistry::instance().make("Hybrid");
  const Chain chain = open_input("yarn:n=1000").animation->frame(0);
  Collisions found;
  variant->build(chain);
  variant->find(chain, {.want = Request::Want::counts}, found);
  EXPECT_EQ(rows[0]["pairs"], found.pair_count);
  Json steps = Json::array();
  for (const WorkDone& done : variant->work()) steps.push_back({{"step", done.step}, {"times", done.times}});
  EXPECT_EQ(rows[0]["steps"], steps);
  EXPECT_FALSE(rows[0].contains("find_ms")) << "it is timed with all others";
}

/// Counts its steps, of which none finds anything.
class Blind final : public Variant {
 public:
  void build(const Chain& chain) override { n_ = chain.size(); }
  void find(const Chain&, const Request&, Collisions& found) override {
    found = {};
    found.count.resize(n_);
  }
  Timings timings() const override { return {}; }
  std::vector<WorkDone> work() const override { return {{"look away", 1}}; }

 private:
  std::size_t n_ = 0;
};

const test::RegisterHidden<Blind> blind{{.name = "Blind", .summary = "blind"}};

TEST(Sections, OfStepsTimeTheLongChainsThatNothingElseTimes) {
  Profile p = profile_of({"Hybrid", "CPU1", "Blind"});
  p.inputs = {{"yarn:n=300"}};
  p.long_inputs = {{"yarn:n=2000"}};
  std::multiset<std::string> named;
  for (const Json& row : section("steps", p)) {
    const std::string input = row["input"], variant = row["variant"];
    named.insert(input + " " + variant);
    EXPECT_EQ(row.contains("find_ms"), input == "yarn/n:2000" && variant == "Hybrid")
        << row << ": no time of a wrong answer";
    if (!row.contains("find_ms")) continue;
    EXPECT_EQ(row["pairs"], exact_pairs("yarn:n=2000", 0));
    EXPECT_GE(row["find_ms"].size(), 6u) << "as many as a median with an interval takes";
    for (const double ms : row["find_ms"]) EXPECT_GT(ms, 0);
  }
  EXPECT_EQ(named, (std::multiset<std::string>{"yarn/n:300 Blind", "yarn/n:300 Hybrid", "yarn/n:2000 Blind",
                                               "yarn/n:2000 Hybrid"}));
}

}  // namespace
}  // namespace catena::reports

#include "catena/bench/regret/regret.h"

#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/register.h"
#include "catena/core/strategy/test_variant.h"

namespace catena::bench {
namespace {

const StrategyRegistry& registry() { return StrategyRegistry::instance(); }
RegretEffort little() { return {.seconds = 0.02, .rounds = 5, .least_ms = 0.02}; }

TEST(Regret, HoldsAutoAgainstTheQuickestOfTheOthers) {
  const std::vector<VariantInfo> two{registry().describe("CPU1"), registry().describe("Hybrid")};
  const Regret few = regret({"path1:n=8"}, two, little()), many = regret({"yarn:n=3000"}, two, little());
  EXPECT_TRUE(few.best == "CPU1" || few.best == "Hybrid") << few.best;
  EXPECT_EQ(many.best, "Hybrid") << "a thirtieth of the other's time";
  for (const Regret& r : {few, many}) {
    EXPECT_TRUE(r.left_out.empty());
    EXPECT_FALSE(r.chosen.empty());
    EXPECT_EQ(r.auto_ms.size(), r.best_ms.size());
    EXPECT_GE(r.auto_ms.size(), 3u);
    EXPECT_GT(r.ratio(), 0);
    EXPECT_EQ(r.first_ms.size(), r.best_first_ms.size());
    EXPECT_GE(r.first_ms.size(), 3u);
    EXPECT_GT(r.first_ratio(), 0);
    EXPECT_FALSE(r.first.empty());
  }
  EXPECT_EQ(few.n, 8u);
  EXPECT_EQ(many.input, "yarn/n:3000");
}

/// By the wall clock where auto takes several threads or a device, be it only after some searches.
TEST(Regret, OfSeveralThreadsIsByTheWallClock) {
  const std::vector<VariantInfo> one{registry().describe("Hybrid")};
  for (const char* input : {"slender:n=8000", "rod:n=100"}) {
    const Regret r = regret({input}, one, little());
    const auto alone = [](const std::string& name) {
      return name.find("threads=") == std::string::npos && !name.starts_with("Device");
    };
    EXPECT_EQ(r.processor, alone(r.first) && alone(r.chosen)) << r.first << ", then " << r.chosen;
  }
}

/// CPU1, after it has kept the processor busy for so many milliseconds. Hidden, so that no other test meets
/// it.
class Busy final : public Variant {
 public:
  Busy(double ms, bool wrong) : ms_(ms), wrong_(wrong) {}
  void build(const Chain& chain) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    ++calls, ++calls_of[ms_];
    const double begin = processor_ms();  // which other work does not lengthen
    while (processor_ms() - begin < ms_) continue;
    all_pairs_->find(chain, request, result);
    if (wrong_) ++result.pair_count;
  }
  Timings timings() const override { return {}; }
  static inline std::size_t calls = 0;
  static inline std::map<double, std::size_t> calls_of;  ///< those that are as busy

 private:
  static double processor_ms() {
    timespec used{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return 1e3 * static_cast<double>(used.tv_sec) + 1e-6 * static_cast<double>(used.tv_nsec);
  }
  double ms_;
  bool wrong_;
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
};

/// Registered once, however often a test is run.
VariantInfo busy(const std::string& name, double ms, bool wrong = false) {
  static std::set<std::string> registered;
  if (registered.insert(name).second)
    StrategyRegistry::instance().add_variant(
        {.name = name, .summary = "busy"}, arithmetic_info<Robust>(),
        [=](const Parameters&) { return std::make_unique<Busy>(ms, wrong); }, true);
  return registry().describe(name);
}

/// Times are told by the variants, in time of the processor.
TEST(Regret, IsOfOnePassOfEachAndOfWhoTakesLeast) {
  const auto slow = busy("BusyForLonger", 0.3), quick = busy("BusyForLess", 0.2);
  for (const auto& others : {std::vector{slow, quick}, std::vector{quick, slow}}) {
    Busy::calls = 0;
    const Regret r = regret({"path1:n=8"}, others, {.seconds = 0.2, .rounds = 9, .least_ms = 3});
    EXPECT_EQ(r.best, "BusyForLess");
    EXPECT_GE(r.best_median(), 0.19) << "of a pass";
    EXPECT_LT(r.best_median(), 0.5) << "and not of all in a sample";
    EXPECT_LT(r.auto_median(), r.best_median()) << "auto is busy with 8 spheres alone";
    EXPECT_GT(Busy::calls, 60u) << "15 passes a sample";
    EXPECT_TRUE(r.processor);
  }
  Regret told{.input = "a/n:1",
              .first = "F",
              .chosen = "A",
              .best = "B",
              .processor = true,
              .first_ms = {9},
              .best_first_ms = {3},
              .auto_ms = {1},
              .best_ms = {2}};
  EXPECT_EQ(to_json(told)["first"], "F");
  EXPECT_EQ(to_json(told)["first_ms"], told.first_ms);
  EXPECT_EQ(to_json(told)["best_first_ms"], told.best_first_ms);
  EXPECT_EQ(told.first_ratio(), 3);
  EXPECT_EQ(to_json(told)["clock"], "processor");
  told.processor = false;
  EXPECT_EQ(to_json(told)["clock"], "wall");
  EXPECT_EQ(to_json(told)["auto_ms"], told.auto_ms);
  EXPECT_EQ(to_json(told)["best_ms"], told.best_ms);
  EXPECT_EQ(told.ratio(), 0.5);
}

/// Who searches slowly until he has settled on another.
class Settling final : public Variant {
 public:
  void build(const Chain& chain) override { first_.build(chain), later_.build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    (searches_++ < 5 ? first_ : later_).find(chain, request, result);
  }
  Timings timings() const override { return {}; }
  std::string answered_by() const override { return searches_ <= 5 ? "at once" : "settled"; }

 private:
  Busy first_{1.2, false}, later_{0.1, false};
  int searches_ = 0;
};

const test::RegisterHidden<Settling> settling{{.name = "Settling", .summary = "slow at once"}};

/// One who searches once has what was chosen at once, whatever many searches would have settled on.
TEST(Regret, OfTheFirstChoiceShowsThoughManySearchesMendIt) {
  const Regret r = regret({"path1:n=8"}, {busy("BusyAsSettled", 0.3)},
                          {.seconds = 0.3, .rounds = 9, .least_ms = 1}, "Settling");
  EXPECT_EQ(r.first, "at once");
  EXPECT_EQ(r.chosen, "settled");
  EXPECT_GT(r.first_ratio(), 2) << "4 times 0.3 ms";
  EXPECT_LT(r.ratio(), 0.8) << "a third of 0.3 ms";
}

/// Counts how often one of them has searched.
class Counted final : public Variant {
 public:
  void build(const Chain& chain) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    most = std::max(most, ++searches_);
    all_pairs_->find(chain, request, result);
  }
  Timings timings() const override { return {}; }
  std::string answered_by() const override { return "Counted"; }
  static inline int most = 0;

 private:
  int searches_ = 0;
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
};
/// CPU1, which keeps how often Counted had searched when this did first.
class AfterCounted final : public Variant {
 public:
  void build(const Chain& chain) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (searches_before < 0) searches_before = Counted::most;
    all_pairs_->find(chain, request, result);
  }
  Timings timings() const override { return {}; }
  static inline int searches_before = -1;

 private:
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
};

const test::RegisterHidden<Counted> counted{{.name = "Counted", .summary = "counts its searches"}};
const test::RegisterHidden<AfterCounted> after_counted{{.name = "AfterCounted", .summary = "looks at them"}};

/// Nobody is timed, with it or before it, until one who searches often has settled.
TEST(Regret, LetsItSettleBeforeOthersAreTried) {
  Counted::most = 0, AfterCounted::searches_before = -1;
  regret({"path1:n=8"}, {registry().describe("AfterCounted")}, little(), "Counted");
  EXPECT_GE(AfterCounted::searches_before, 40);
}

/// What took less than twice the least when it was tried is timed in turns; what took more was tried alone.
TEST(Regret, TimesInTurnsWhoTookLessThanTwiceTheLeast) {
  const std::vector others{busy("BusyThrice", 0.6), busy("BusyOnce", 0.2), busy("BusyHalfAsLongAgain", 0.3)};
  Busy::calls_of.clear();
  regret({"path1:n=8"}, others, {.seconds = 0.2, .rounds = 9, .least_ms = 1});
  EXPECT_LT(Busy::calls_of[0.6], 10u) << "1, then 1 and 2 to try it";
  EXPECT_GT(Busy::calls_of[0.3], 18u) << "5 samples of 4 more";
}

TEST(Regret, TimesNobodyWhoIsWrong) {
  EXPECT_THROW(regret({"path1:n=8"}, {busy("BusyAndWrong", 0.01, true)}, little()), Error);
}

TEST(Regret, SaysWhyAnInputIsLeftOut) {
  const std::vector<VariantInfo> one{registry().describe("Hybrid")};
  EXPECT_NE(regret({"winding:n=300000"}, one, little()).left_out.find("overlap"), std::string::npos);
  EXPECT_FALSE(regret({"yarn:n=30"}, {}, little()).left_out.empty());
}

TEST(Regret, IsOfWhatAUserOfThisHostMightTakeInstead) {
  const auto others = regret_variants(registry().variants(true));
  EXPECT_TRUE(std::ranges::none_of(others, &VariantInfo::hidden));
  const auto among = [&](const char* name) {
    return std::ranges::find(others, name, &VariantInfo::name) != others.end();
  };
  for (const char* name : {"Hybrid", "Grid", "ChainTree", "CPU1", "aCPU2+Dual"})
    EXPECT_TRUE(among(name)) << name;
  for (const char* name : {"auto", "CPU1/literal", "aGPU2@host+GPU2@host"}) EXPECT_FALSE(among(name)) << name;
}

TEST(Regret, EverySceneCanBeOpened) {
  const auto scenes = all_scenes(64);
  EXPECT_GE(scenes.size(), 25u);
  for (const WorkloadSpec& scene : scenes) EXPECT_EQ(open_input(scene.input).animation->frame(0).size(), 64u);
}

}  // namespace
}  // namespace catena::bench

#include "catena/core/plan/machine.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "catena/core/executor/usable_cores.h"
#include "catena/core/plan/calibrate.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"

namespace catena {
namespace {

class MachineFile : public testing::Test {
 protected:
  MachineFile()
      : file_(std::filesystem::temp_directory_path() / ("catena-machine-" + std::to_string(getpid()))) {}
  ~MachineFile() override { std::filesystem::remove(file_); }
  Machine read(const std::string& text) const {
    std::ofstream(file_) << text;
    return Machine::from(file_);
  }
  static const MachineCost& cost_of(const Machine& machine, const std::string& variant) {
    return std::ranges::find(machine.costs, variant, &Machine::VariantCost::variant)->cost;
  }
  const std::filesystem::path file_;
};

TEST_F(MachineFile, ComesBackAsItWasWritten) {
  Machine machine = Machine::built_in();
  ASSERT_GE(machine.costs.size(), 2u);
  for (Machine::VariantCost& v : machine.costs)
    v.cost.fixed_us += 1, v.cost.sphere_ns += 0.1, v.cost.serial *= v.cost.serial < 1 ? 0.5 : 1,
        v.cost.team_us += 3, v.cost.start_ms += 7;
  const Machine back = read(calibration_text(machine));
  EXPECT_FALSE(back.warning);
  EXPECT_NE(back.source.find(file_.string()), std::string::npos) << back.source;
  ASSERT_EQ(back.costs.size(), machine.costs.size());
  for (const Machine::VariantCost& v : machine.costs)
    EXPECT_EQ(cost_of(back, v.variant), v.cost) << v.variant;
}

TEST_F(MachineFile, ThatIsNotThereGivesTheBuiltInFiguresInSilence) {
  const Machine machine = Machine::from(file_);
  EXPECT_FALSE(machine.warning);
  EXPECT_EQ(machine.source, Machine::built_in().source);
}

/// A pipe is not waited for.
TEST_F(MachineFile, ThatIsNoFileIsOneLineAndGivesTheBuiltInFigures) {
  for (const bool pipe : {false, true}) {
    ASSERT_EQ(pipe ? mkfifo(file_.c_str(), 0600) : mkdir(file_.c_str(), 0700), 0);
    const Machine machine = Machine::from(file_);
    EXPECT_EQ(machine.warning.value_or(""),
              file_.string() + " is no file; using built-in figures; catena calibrate needs its place");
    EXPECT_EQ(machine.source, Machine::built_in().source);
    std::filesystem::remove(file_);
  }
  EXPECT_FALSE(Machine::from(file_).warning) << "there is none";
}

TEST_F(MachineFile, ThatIsDamagedIsOneLineAndGivesTheBuiltInFigures) {
  const Machine built_in = Machine::built_in();
  std::string good = calibration_text(built_in);
  std::vector<std::string> damaged{"", "nonsense"};
  for (std::size_t length = 1; length + 1 < good.size(); length += 3)
    damaged.push_back(good.substr(0, length));
  for (const char* figure : {"nan", "-1", "inf", "1e999", "1e308", "x", ""})
    damaged.push_back(
        std::string(good).insert(good.rfind("end"), std::string("CPU1 1 2 3 1 5 ") + figure + "\n"));
  for (const char* line :
       {"CPU1 -1 2 3 1 4 5\n", "CPU1 1 -2 3 1 4 5\n", "CPU1 1 2 -3 1 4 5\n", "CPU1 1 2 3 -1 4 5\n",
        "CPU1 1 2 3 1 -4 5\n", "CPU1 1 2 3 1 4 5 6\n", "CPU1 1 2 3 1.01 4 5\n", "CPU1 1 2 3 1 4\n",
        "CPU1 1 2 3\n", "CPU1 1 2 1e308 1 4 5\n"})
    damaged.push_back(std::string(good).insert(good.rfind("end"), line));
  damaged.push_back(std::string(good).insert(good.find("processor ") + 10, "another "));
  damaged.push_back(good.substr(0, good.find('\n', good.find("processor")) + 1) + "end\n");
  Machine several = built_in;  // threads of what knows none
  std::ranges::find(several.costs, 1, [](const auto& v) { return v.cost.serial; })->cost.serial = 0.5;
  damaged.push_back(calibration_text(several));
  Machine second_bad = built_in;
  second_bad.costs[1].cost.fixed_us = -1;
  const std::string first_bad = calibration_text(second_bad);
  EXPECT_NE(read(first_bad).warning.value_or("").find(" line 4 is not"), std::string::npos) << first_bad;
  for (const std::string& text : damaged) {
    const Machine machine = read(text);
    ASSERT_TRUE(machine.warning) << text;
    EXPECT_EQ(std::ranges::count(*machine.warning, '\n'), 0) << *machine.warning;
    EXPECT_NE(machine.warning->find(file_.string()), std::string::npos) << *machine.warning;
    EXPECT_EQ(machine.source, built_in.source);
    ASSERT_EQ(machine.costs.size(), built_in.costs.size());
    for (const Machine::VariantCost& v : built_in.costs)
      EXPECT_EQ(cost_of(machine, v.variant), v.cost) << text;
  }
}

TEST_F(MachineFile, LiesInTheFolderForCachesWhoseNameIsAbsolute) {
  const auto with = [](const char* cache, const char* home) {
    const auto put = [](const char* name, const char* value) {
      value ? setenv(name, value, 1) : unsetenv(name);
    };
    const char* const names[] = {"XDG_CACHE_HOME", "HOME"};
    std::optional<std::string> before[2];
    for (int k = 0; k < 2; ++k)
      if (const char* value = std::getenv(names[k])) before[k] = value;
    put(names[0], cache), put(names[1], home);
    const std::string file = calibration_file().string();
    for (int k = 0; k < 2; ++k) put(names[k], before[k] ? before[k]->c_str() : nullptr);
    return file;
  };
  EXPECT_EQ(with("/a", "/b"), "/a/catena/calibration.txt");
  for (const char* none : {static_cast<const char*>(nullptr), "", "relative", "./a"}) {
    EXPECT_EQ(with(none, "/b"), "/b/.cache/catena/calibration.txt");
    EXPECT_EQ(with(none, nullptr), "");
    EXPECT_EQ(with(none, "relative"), "");
  }
}

TEST_F(MachineFile, OfVariantsThatAreGoneIsUsedForTheOthers) {
  Machine machine = Machine::built_in();
  const std::string variant = machine.costs[0].variant;
  machine.costs = {{"Gone", {{1, 2, 3}}}, {variant, {{4, 5, 6}}}};
  const Machine back = read(calibration_text(machine));
  EXPECT_FALSE(back.warning);
  EXPECT_EQ(cost_of(back, variant), (MachineCost{{4, 5, 6}}));
  EXPECT_EQ(std::ranges::count(back.costs, std::string("Gone"), &Machine::VariantCost::variant), 0);
}

/// Whatever a processor is called by, another kind is called otherwise.
TEST_F(MachineFile, TellsKindsOfProcessorsApart) {
  const auto named = [](const std::string& cpuinfo) {
    std::istringstream text(cpuinfo);
    return processor_of(text);
  };
  EXPECT_EQ(named("vendor_id\t: A\ncpu family\t: 6\nmodel name\t: A 5\ncpu MHz\t: 9\n\nmodel name\t: B\n"),
            "A 5");
  const std::string arm =
      "processor\t: 0\nBogoMIPS\t: 243\nCPU implementer\t: 0x41\nCPU architecture: 8\n"
      "CPU variant\t: 0x3\nCPU part\t: 0xd0c\nCPU revision\t: 1\n\n";
  EXPECT_EQ(named(arm + arm), named(arm));
  std::string other = arm;
  other.replace(other.find("0xd0c"), 5, "0xd40");
  EXPECT_NE(named(arm), named(other));
  EXPECT_NE(named(arm), named(arm + other)) << "of two kinds";
  EXPECT_NE(named("cpu\t\t: POWER9\n"), named("cpu\t\t: POWER10\n"));
  EXPECT_EQ(named("processor\t: 0\nmodel name\t:\n"), "");
  EXPECT_EQ(named(""), "unknown");
}

/// A device is known before it is looked for; of the host, only what is there.
TEST(Machine, KnowsWhatSaysWhatItCosts) {
  const Machine machine = Machine::built_in();
  EXPECT_EQ(machine.cores, usable_cores());
  std::size_t devices = 0;
  for (const std::string& name : StrategyRegistry::instance().strategy_names()) {
    const StrategyInfo& info = StrategyRegistry::instance().strategy(name);
    const bool device = info.place.on_device(), there = !(info.unavailable && info.unavailable());
    EXPECT_EQ(std::ranges::count(machine.costs, name, &Machine::VariantCost::variant),
              info.cost && !info.peer && (device || there))
        << name;
    devices += info.cost && device;
  }
  EXPECT_EQ(std::ranges::count(machine.costs, true, &Machine::VariantCost::on_device), devices);
}

/// Who took what such costs foretell has them, whichever it is that they count.
TEST(Calibrate, FindsTheLineThatTwoSearchesAreOf) {
  for (const bool all_pairs : {false, true})
    for (const double fixed_us : {0.0, 5.0}) {
      Machine::VariantCost v{.variant = "any", .cost = {}, .all_pairs = all_pairs};
      v.cost.serial = 0.5, v.cost.team_us = 3;
      MachineCost true_cost = v.cost;
      true_cost.fixed_us = fixed_us;
      (all_pairs ? true_cost.sphere_pair_ns : true_cost.sphere_ns) = 2;
      const auto took = [&](std::uint32_t n) { return SearchTook{n, true_cost.ms(n) * 1e3}; };
      const MachineCost found = cost_through(v, took(16), took(256));
      for (const std::uint32_t n : {1u, 16u, 100u, 1000u})
        for (const unsigned threads : {1u, 2u})
          EXPECT_NEAR(found.ms(n, threads), true_cost.ms(n, threads), 1e-9 * n) << all_pairs << fixed_us;
      EXPECT_NEAR(found.fixed_us, fixed_us, 1e-9);
      const MachineCost noise = cost_through(v, {16, 9}, {256, 8});
      EXPECT_EQ(noise.fixed_us, 9) << "more spheres take no less";
      EXPECT_EQ(all_pairs ? noise.sphere_pair_ns : noise.sphere_ns, 0);
    }
}

TEST(Calibrate, FindsThatATreePaysForLongChainsAlone) {
  const Machine machine = calibrate(), built_in = Machine::built_in();
  for (const Machine::VariantCost& v : machine.costs) {
    EXPECT_GT(v.cost.ms(100000), 0) << v.variant;
    EXPECT_TRUE(std::isfinite(v.cost.ms(100000))) << v.variant;
    EXPECT_FALSE(v.unavailable && v.unavailable()) << v.variant;
    // No processor takes less, nor anyone's patience more: figures that are of another unit.
    const double item_ns = v.all_pairs ? v.cost.sphere_pair_ns : v.cost.sphere_ns;
    if (!v.on_device) {
      EXPECT_GT(item_ns, 0.05) << v.variant;
      EXPECT_LT(item_ns, 1e6) << v.variant;
      EXPECT_EQ(v.all_pairs ? v.cost.sphere_ns : v.cost.sphere_pair_ns, 0) << v.variant;
    }
    // Other threads have to wake: no run tells that they cost nothing.
    const auto usual = std::ranges::find(built_in.costs, v.variant, &Machine::VariantCost::variant);
    ASSERT_NE(usual, built_in.costs.end()) << v.variant;
    EXPECT_GE(v.cost.team_us, usual->cost.team_us / 4) << v.variant;
  }
  EXPECT_EQ(machine.source, "measured now");
  EXPECT_GE(crossover(machine), 2u);
  EXPECT_LE(crossover(machine), 2000u);

  // They foretell a search of another length, to the order of magnitude even beside other work.
  for (const Machine::VariantCost& v : machine.costs) {
    EXPECT_FALSE(v.unavailable && v.unavailable()) << v.variant;
    if (v.on_device) continue;
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < (v.all_pairs ? 100 : 2000); ++i)
      spheres.push_back(
          {10 * std::cos(i / 10.0f), 10 * std::sin(i / 10.0f), 0.05f * static_cast<float>(i), 1});
    const Chain chain(std::move(spheres));
    const auto variant = StrategyRegistry::instance().make(v.variant);
    double least = std::numeric_limits<double>::infinity();
    Collisions found;
    for (int k = 0; k < 20; ++k) {
      const Stopwatch watch;
      variant->build(chain);
      variant->find(chain, {}, found);
      least = std::min(least, watch.ms());
    }
    EXPECT_GT(v.cost.ms(chain.size()), least / 10) << v.variant;
    EXPECT_LT(v.cost.ms(chain.size()), least * 10) << v.variant;
  }
}

/// As a loaded machine measures it; a variant that knows no threads is no such sign, nor is one core.
TEST(Calibrate, NamesWhomThreadsHardlyHelped) {
  Machine machine;
  machine.cores = 2;
  machine.costs = {{"Hybrid", {{}, 0.999}}, {"Grid", {{}, 0.3}}, {"ChainTree", {{}, 1}}};
  EXPECT_EQ(hardly_helped_by_threads(machine), std::vector<std::string>{"Hybrid"});
  machine.cores = 1;
  EXPECT_EQ(hardly_helped_by_threads(machine), std::vector<std::string>{});
}

/// By the figures of the host's variants, whatever a device takes.
TEST(Calibrate, TellsFromHowManySpheresOnATreeIsCheaper) {
  const auto machine = [](double fixed_us, double pair_ns) {
    return Machine{{{"pairs", {{.sphere_pair_ns = pair_ns}}, false, true},
                    {"slow pairs", {{.sphere_pair_ns = 3 * pair_ns}}, false, true},
                    {"tree", {{.fixed_us = fixed_us, .sphere_ns = 9}}},
                    {"device", {{.sphere_ns = 1e-3}}, true},
                    {"pairs on a device", {{.sphere_pair_ns = 1e-6}}, true, true}},
                   "a test",
                   {}};
  };
  for (const double fixed_us : {0.5, 1.2, 40.})
    for (const double pair_ns : {0.3, 2., 10.}) {
      const Machine of = machine(fixed_us, pair_ns);
      const std::uint32_t from = crossover(of);
      EXPECT_LT(of.costs[2].cost.ms(from), of.costs[0].cost.ms(from)) << from;
      EXPECT_GE(of.costs[2].cost.ms(from - 1), of.costs[0].cost.ms(from - 1)) << from;
    }
  Machine trees = machine(1, 1);
  trees.costs.erase(trees.costs.begin(), trees.costs.begin() + 2);
  EXPECT_EQ(crossover(trees), 0u) << "there is nothing to compare";
  Machine pairs = machine(1, 1);
  pairs.costs.erase(pairs.costs.begin() + 2);
  EXPECT_EQ(crossover(pairs), 0u) << "nor here";
}

TEST(MachineCost, IsOfOneThreadWhereAVariantKnowsNoOthers) {
  const auto& registry = StrategyRegistry::instance();
  std::size_t several = 0;
  for (const Machine::VariantCost& v : Machine::built_in().costs) {
    const bool knows =
        std::ranges::count(registry.strategy(v.variant).parameters, "threads", &ParameterInfo::name) > 0;
    EXPECT_EQ(v.cost.serial < 1, knows) << v.variant;
    EXPECT_EQ(v.cost.team_us > 0, knows) << v.variant;
    several += knows;
  }
  EXPECT_GT(several, 0u);
  const MachineCost cost{
      {10, 100, 0}, 0.25, 50};  // 10 us, 100 ns a sphere of which a quarter is one thread's
  EXPECT_DOUBLE_EQ(cost.ms(1000), 0.01 + 0.1);
  EXPECT_DOUBLE_EQ(cost.ms(1000, 4), 0.01 + 0.1 * (0.25 + 0.75 / 4) + 0.05);
}

}  // namespace
}  // namespace catena

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/scenes/random.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/forced_target.h"

// No cliff: a chain that differs a little is not searched at a much greater cost. By counts, so that no clock
// is asked; what each costs need only be about right, for a jump shows all the same.
namespace catena {
namespace {

constexpr std::uint32_t n = 20'000;

/// About nanoseconds on one core.
double cost(const HybridSearch::Work& work) {
  return 4.0 * n + 25.0 * static_cast<double>(work.rows) + 8.0 * static_cast<double>(work.entries) +
         25.0 * static_cast<double>(work.near) + 20.0 * static_cast<double>(work.sixteens) +
         6.0 * static_cast<double>(work.tests) + 6.0 * static_cast<double>(work.crowded) +
         40.0 * static_cast<double>(work.dense);
}

HybridSearch::Work work_of(const Chain& chain, const HybridSearch::Settings& settings) {
  const Team alone;
  const ChainView view = chain.view();
  HybridSearch search(settings, 1);
  search.build(view, alone);
  Collisions found;
  PairCollector collector(view.size, {Request::Want::counts}, found);
  search.search(view, collector, alone);
  collector.finish();
  return search.work();
}

/// Hybrid's own.
HybridSearch::Settings defaults() {
  const auto& parameters = StrategyRegistry::instance().strategy("Hybrid").parameters;
  const auto value = [&](const char* name) {
    return std::ranges::find(parameters, name, &ParameterInfo::name)->default_value;
  };
  return {static_cast<std::uint32_t>(std::stoul(value("crowd"))), std::stod(value("dense"))};
}

/// The greatest factor between the costs of two neighbours of a sweep in steps of 1 %, on any instruction
/// set, as what they take decides how spheres are searched; but for one without vectors, which no machine
/// has.
double greatest_jump(const std::function<Chain(double)>& chain, double from, double to, bool& crowded) {
  std::map<std::int64_t, double> before;
  double greatest = 1;
  crowded = false;
  for (double p = from; p <= to; p *= 1.01) {
    const Chain here = chain(p);
    for (const std::int64_t target : properties::targets_here()) {
      if (target == HWY_EMU128 || target == HWY_SCALAR) continue;
      const properties::ForcedTarget forced(target);
      const HybridSearch::Work work = work_of(here, defaults());
      const double now = cost(work);
      if (const auto last = before.find(target); last != before.end())
        greatest = std::max({greatest, now / last->second, last->second / now});
      before[target] = now;
      crowded = crowded || work.crowded > 0;
    }
  }
  return greatest;
}

/// A walk that stays near the origin, steps of 1.
std::vector<Sphere> ball(double radius, double other_radius) {
  Random random(7);
  std::vector<Sphere> spheres;
  double at[3] = {0, 0, 0}, way[3] = {1, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]),
                       static_cast<float>(i % 2 == 0 ? radius : other_radius)});
    double length = 0;
    for (int d = 0; d < 3; ++d) {
      way[d] += 0.6 * (random.unit() - 0.5) - 0.01 * at[d];
      length += way[d] * way[d];
    }
    for (int d = 0; d < 3; ++d) at[d] += way[d] /= std::sqrt(length);
  }
  return spheres;
}

constexpr double most = 1.5;

TEST(SteadyWork, OverTheThicknessOfABall) {
  bool crowded;
  EXPECT_LT(greatest_jump([](double r) { return Chain(ball(r, r)); }, 0.3, 2.0, crowded), most);
  EXPECT_TRUE(crowded) << "the sweep passes no border";
}

TEST(SteadyWork, OverTheRatioOfRadii) {
  bool crowded;
  EXPECT_LT(greatest_jump([](double q) { return Chain(ball(0.5, 0.5 * q)); }, 1, 8, crowded), most);
  EXPECT_TRUE(crowded);
}

TEST(SteadyWork, OverThePitchOfACoil) {
  bool crowded;
  const auto coil = [](double pitch) {
    constexpr double turn = 300, radius = 0.5;
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / turn, around = turn * 0.8 / (2 * M_PI);
      spheres.push_back({static_cast<float>(around * std::cos(angle)),
                         static_cast<float>(around * std::sin(angle)), static_cast<float>(pitch * i / turn),
                         static_cast<float>(radius)});
    }
    return Chain(std::move(spheres));
  };
  EXPECT_LT(greatest_jump(coil, 0.05, 0.12, crowded), most);
  EXPECT_TRUE(crowded);
}

/// Radii of a ball drawn from a range, where one width of cells serves no more from some ratio on.
TEST(SteadyWork, OverTheRangeOfRadii) {
  bool crowded;
  const auto drawn = [](double ratio) {
    std::vector<Sphere> spheres = ball(0.5, 0.5);
    Random random(3);
    for (Sphere& s : spheres) s.radius *= static_cast<float>(std::pow(ratio, -random.unit()));
    return Chain(std::move(spheres));
  };
  EXPECT_LT(greatest_jump(drawn, 1, 100, crowded), most);
  EXPECT_TRUE(crowded);
}

TEST(SteadyWork, OverTheDensityOfPoints) {
  bool crowded;
  const auto points = [](double side) {
    Random random(4);
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto at = [&] { return static_cast<float>(side * random.unit()); };
      spheres.push_back({at(), at(), at(), 0.5f});
    }
    return Chain(std::move(spheres));
  };
  EXPECT_LT(greatest_jump(points, 15, 600, crowded), most);
  EXPECT_TRUE(crowded);
}

/// A winding path whose steps become longer, until blocks are no capsules any more.
TEST(SteadyWork, OverTheStepOfATangle) {
  bool crowded;
  const auto stretched = [](double step) {
    std::vector<Sphere> spheres = ball(0.5, 0.5);
    for (Sphere& s : spheres) s.radius /= static_cast<float>(step);
    return Chain(std::move(spheres));
  };
  EXPECT_LT(greatest_jump(stretched, 0.5, 20, crowded), most);
  EXPECT_TRUE(crowded);
}

/// Pairs of nodes that a search compares.
struct NodePairs final : EvidenceSink {
  std::uint64_t pairs = 0;
  void discarded(std::uint32_t, std::uint32_t) override {}
  void tested(std::uint32_t, std::uint32_t) override {}
  void excluded(std::uint32_t, std::uint32_t) override {}
  void compared(std::uint32_t, std::uint32_t) override { ++pairs; }
};

/// Sheets of ways back and forth, off the axes: where ways are as long as nodes of the tree the middles of
/// these say nothing of how they lie.
TEST(SteadyWork, OfWaysAsLongAsNodes) {
  const auto pairs_of = [](std::uint32_t way) {
    constexpr std::uint32_t spheres_in_all = 5 * n, rows = 28;
    const double along[3] = {0.36, 0.48, 0.8}, across[3] = {0.8, -0.6, 0}, up[3] = {0.48, 0.64, -0.6};
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < spheres_in_all; ++i) {
      const std::uint32_t row = i / way, k = i % way, sheet = row / rows, of_sheet = row % rows;
      const double x = 1.6 * (row % 2 == 0 ? k : way - 1 - k), z = 2.5 * sheet,
                   y = 2.5 * (sheet % 2 == 0 ? of_sheet : rows - 1 - of_sheet);
      const auto at = [&](int d) { return static_cast<float>(x * along[d] + y * across[d] + z * up[d]); };
      spheres.push_back({at(0), at(1), at(2), 1});
    }
    const Chain chain(std::move(spheres));
    const auto tree = StrategyRegistry::instance().make("ChainTree");
    tree->build(chain);
    NodePairs seen;
    Collisions found;
    tree->find_with_evidence(chain, {}, found, seen);
    return static_cast<double>(seen.pairs);
  };
  EXPECT_LT(pairs_of(128), 1.5 * pairs_of(64));
  EXPECT_LT(pairs_of(256), 1.5 * pairs_of(192));
}

/// Wisps of hair, so few that no node can meet more others than the chain's order bears: that their blocks
/// meet many is told by what a search of them would cost.
TEST(SteadyWork, OfFewNodesThatAllMeet) {
  constexpr std::uint32_t strand = 100, strands = 30;
  Random random(7);
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> first;
  for (std::uint32_t w = 0; w < strands; ++w) {
    const double from = 2 * M_PI * random.unit(), root = 3 * std::sqrt(random.unit());
    first.push_back(w * strand);
    for (std::uint32_t i = 0; i < strand; ++i) {
      const double away = root * (1 - 0.007 * i), angle = from + 0.05 * i, bend = 20 * std::cos(0.04 * i);
      spheres.push_back({static_cast<float>(bend + away * std::cos(angle)),
                         static_cast<float>(away * std::sin(angle)), static_cast<float>(0.6 * i), 0.25f});
    }
  }
  first.push_back(strands * strand);
  const Chain chain(std::move(spheres), Strands{.first = std::move(first), .closed = {}});
  EXPECT_GE(work_of(chain, defaults()).crowded, chain.size());
}

/// A snake that swells and shrinks by decades, in whose own folds hundreds overlap: blocks find them eight by
/// eight, in cells each would be tested.
TEST(SteadyWork, OfFoldsWhereHundredsOverlap) {
  Random random(7);
  const auto between = [&] { return 2 * random.unit() - 1; };
  std::vector<Sphere> spheres;
  double at[3] = {0, 0, 0}, way[3] = {1, 0, 0}, size = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    size = 0.9995 * (size + 0.15 * between());
    const double radius = std::exp(3 * size);
    spheres.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]),
                       static_cast<float>(radius)});
    double length = 0;
    for (double& w : way) w += 0.25 * between(), length += w * w;
    for (int d = 0; d < 3; ++d) at[d] += 1.6 * radius * (way[d] /= std::sqrt(length));
  }
  const Chain chain(std::move(spheres));
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    const HybridSearch::Work work = work_of(chain, defaults());
    EXPECT_EQ(work.crowded, 0) << hwy::TargetName(target);
    EXPECT_GT(work.near, 0) << hwy::TargetName(target);
  }
}

/// The measure itself sees a cliff: a search that gives the chain's order up at a few meetings jumps.
TEST(SteadyWork, SeesACliff) {
  bool crowded;
  const auto two_balls = [](double r) {
    // A straight chain that is a ball from some thickness on.
    std::vector<Sphere> spheres = r < 0.6 ? std::vector<Sphere>() : ball(0.5, 0.5);
    for (std::uint32_t i = 0; spheres.size() < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.5f});
    return Chain(std::move(spheres));
  };
  EXPECT_GT(greatest_jump(two_balls, 0.58, 0.62, crowded), most);
}

}  // namespace
}  // namespace catena

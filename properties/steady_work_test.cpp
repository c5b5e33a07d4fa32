#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/chain/chain.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/scenes/random.h"
#include "catena/core/strategy/registry.h"

// No cliff: a chain that differs a little is not searched at a much greater cost. By counts, so that no clock
// is asked; what each costs need only be about right, for a jump shows all the same.
namespace catena {
namespace {

constexpr std::uint32_t n = 20'000;

/// About nanoseconds on one core.
struct Work {
  std::uint64_t rows = 0, pairs = 0, tests = 0, crowd = 0;
  double cost() const {
    return 4.0 * n + 25.0 * static_cast<double>(rows) + 20.0 * static_cast<double>(pairs) +
           10.0 * static_cast<double>(crowd) + 6.0 * static_cast<double>(tests);
  }
};

/// What Hybrid does; its parts are called as it calls them.
Work work_of(const Chain& chain, std::uint32_t limit) {
  const Team alone;
  const ChainView view = chain.view();
  BlockTree tree;
  Crowding crowding;
  build_block_tree(view, tree, alone);
  find_crowds(tree, limit, crowding, alone);
  std::vector<std::uint32_t> crowd;
  for (std::uint32_t i = 0; i < n; ++i)
    if (crowding.crowded(i / (BlockTree::block * BlockTree::group))) crowd.push_back(i);
  std::vector<BlockQueues> blocks(1);
  std::vector<GridQueues> cells(1);
  Collisions found;
  PairCollector collector(n, {Request::Want::counts}, found);
  search_uncrowded(view, tree, crowding, blocks, collector, alone);
  if (!crowd.empty()) {
    SphereGrid grid;
    build_grid(view, grid, crowd, alone);
    search_grid(view, grid, cells, collector, alone);
  }
  collector.finish();
  return {blocks[0].rows_done(), blocks[0].pairs_done(), cells[0].tests_done, crowd.size()};
}

/// The greatest factor between the costs of two neighbours of a sweep in steps of 1 %.
double greatest_jump(const std::function<Chain(double)>& chain, double from, double to, std::uint32_t limit,
                     bool& crowded) {
  double greatest = 1, before = 0;
  crowded = false;
  for (double p = from; p <= to; p *= 1.01) {
    const Work work = work_of(chain(p), limit);
    if (before > 0) greatest = std::max({greatest, work.cost() / before, before / work.cost()});
    before = work.cost();
    crowded = crowded || work.crowd > 0;
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

/// Hybrid's own, where it gives the chain's order up.
std::uint32_t default_limit() {
  const auto& parameters = StrategyRegistry::instance().strategy("Hybrid").parameters;
  const auto crowd = std::ranges::find(parameters, "crowd", &ParameterInfo::name);
  return static_cast<std::uint32_t>(std::stoul(crowd->default_value));
}

constexpr double most = 1.5;

TEST(SteadyWork, OverTheThicknessOfABall) {
  bool crowded;
  EXPECT_LT(greatest_jump([](double r) { return Chain(ball(r, r)); }, 0.3, 2.0, default_limit(), crowded),
            most);
  EXPECT_TRUE(crowded) << "the sweep passes no border";
}

TEST(SteadyWork, OverTheRatioOfRadii) {
  bool crowded;
  EXPECT_LT(greatest_jump([](double q) { return Chain(ball(0.5, 0.5 * q)); }, 1, 8, default_limit(), crowded),
            most);
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
  EXPECT_LT(greatest_jump(coil, 0.05, 0.12, default_limit(), crowded), most);
  EXPECT_TRUE(crowded);
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
  EXPECT_GT(greatest_jump(two_balls, 0.58, 0.62, default_limit(), crowded), most);
}

}  // namespace
}  // namespace catena

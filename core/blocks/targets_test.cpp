#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "catena/core/blocks/simd_targets.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/forced_target.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"
#include "catena/properties/property.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/reference.h"
#include "hwy/highway.h"

namespace catena {
namespace {

struct Solved {
  std::string name;
  Chain chain;
  reference::Answer right;
};

/// Spheres of which each has one that touches it to the last bit, or misses that by one or two: (3, 4, 0) k
/// apart with radii that add up to 5 k, times `factor`, by which none, some or all of this stays exact, and
/// times one of so many powers of two for each.
Chain near_ties(properties::Dice& dice, std::uint32_t pairs, float all_times, int octaves = 0) {
  std::vector<Sphere> first, second;
  for (std::uint32_t p = 0; p < pairs; ++p) {
    const float factor = std::ldexp(all_times, dice.between(0, octaves));
    const int k = dice.between(1, 1000), own = dice.between(0, 5 * k);
    const auto at = static_cast<float>(p % 64) * 0x1p14f;
    const auto size = static_cast<float>(k);
    float other = static_cast<float>(5 * k - own) * factor;
    for (int ulp = dice.between(-2, 2); ulp != 0; ulp -= ulp > 0 ? 1 : -1)
      other = std::nextafter(other, ulp > 0 ? INFINITY : 0.0f);
    first.push_back({at * factor, 0, at * factor, static_cast<float>(own) * factor});
    second.push_back({(at + 3 * size) * factor, 4 * size * factor, at * factor, other});
  }
  first.insert(first.end(), second.begin(), second.end());
  return Chain(std::move(first));
}

/// The same in another order: of every sixteen each touches another one of them.
Chain ties_side_by_side(properties::Dice& dice, std::uint32_t pairs, float all_times, int octaves = 0) {
  const Chain apart = near_ties(dice, pairs, all_times, octaves);
  std::vector<Sphere> spheres;
  for (std::uint32_t p = 0; p + 8 <= pairs; p += 8) {
    const auto begin = spheres.size();
    for (std::uint32_t k = p; k < p + 8; ++k)
      for (const std::uint32_t i : {k, pairs + k}) spheres.push_back(apart[i]);
    for (std::uint32_t left = 16; left > 1; --left)
      std::swap(spheres[begin + left - 1], spheres[begin + dice.below(left)]);
  }
  return Chain(std::move(spheres));
}

/// A chain of every family, tangles about the limits of vectors, blocks and nodes, rows of nodes, and ties.
std::vector<Solved> solved_chains() {
  std::vector<Solved> solved;
  const auto add = [&](const std::string& name, Chain chain) {
    reference::Answer right = reference::find(chain);
    solved.push_back({name, std::move(chain), std::move(right)});
  };
  std::uint64_t seed = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families()) {
    properties::Dice dice(++seed);
    add(family.name, properties::generate(family, dice, 300));
  }
  for (const std::uint32_t n : {0u, 1u, 7u, 9u, 17u, 129u, 2100u}) {
    properties::Dice dice(++seed);
    add("tangle of " + std::to_string(n), Chain(properties::tangle(dice, n)));
  }
  // Most of what is near overlaps: whole blocks are counted, among them the last, which is not filled.
  for (const std::uint32_t n : {403u, 1005u}) {
    properties::Dice dice(++seed);
    std::vector<Sphere> spheres = properties::tangle(dice, n);
    for (Sphere& s : spheres) s.radius *= static_cast<float>(dice.between(1, 6));
    add("heap of " + std::to_string(n), Chain(std::move(spheres), {}, Exclusion::index(dice.pick({1u, 3u}))));
  }
  // Neighbours that end within a block, at its end, and beyond it; and blocks that a strand does not fill.
  for (const std::uint32_t window : {1u, 3u, 7u, 8u, 9u, 15u, 16u, 17u, 40u})
    for (const std::uint32_t strand : {401u, 400u, 200u, 21u}) {
      properties::Dice dice(++seed);
      std::vector<Sphere> spheres = properties::tangle(dice, 400);
      Strands strands;
      strands.first = {0};
      for (std::uint32_t at = 0; at < 400; at += strand) {
        strands.first.push_back(std::min(at + strand, 400u));
        strands.closed.push_back(strand == 401 || at / strand % 3 == 1);
      }
      add("window " + std::to_string(window) + " on strands of " + std::to_string(strand),
          Chain(std::move(spheres), std::move(strands), Exclusion::index(window)));
    }
  for (const char* scene : {"path1:n=6000", "path2:n=3000", "rod:n=4500"})
    add(scene, SceneRegistry::instance().open(scene)->frame(0));
  for (const float factor : {1.0f, 0x1p-140f, 0x1p-60f, 0x1p90f, 0.1f, 1e-12f, 1e25f}) {
    properties::Dice dice(++seed);
    add("ties times " + std::to_string(factor), near_ties(dice, 500, factor));
    add("ties beside " + std::to_string(factor), ties_side_by_side(dice, 200, factor));
  }
  for (const auto& [least, octaves] : {std::pair{0x1p-148f, 240}, {0x1p-148f, 60}, {0x1p-80f, 180}}) {
    properties::Dice dice(++seed);
    add("ties over octaves " + std::to_string(octaves), near_ties(dice, 500, least, octaves));
    add("ties beside over octaves " + std::to_string(octaves), ties_side_by_side(dice, 500, least, octaves));
  }
  return solved;
}

/// Machines differ in the best that they have: what another one runs is run here too, as far as this one can.
TEST(SimdTargets, GiveTheExactPairsEachOfThem) {
  const std::vector<std::int64_t> targets = properties::targets_here();
  ASSERT_FALSE(targets.empty());
  const std::vector<Solved> solved = solved_chains();
  EXPECT_TRUE(std::ranges::any_of(solved, [](const Solved& s) { return s.right.pair_count > 1000; }));
  std::set<std::size_t> chosen;
  for (const std::int64_t target : targets) {
    const properties::ForcedTarget forced(target);
    for (const char* name : {"ChainTree", "ChainTree(rows=search)", "Grid(cells=wide)", "Grid(cells=narrow)",
                             "Hybrid", "Hybrid(rows=search)", "Hybrid(crowd=0)", "Hybrid(crowd=0,dense=0)",
                             "Hybrid(crowd=0,dense=0.2)", "Hybrid(crowd=0,dense=1e6)", "SphereTree"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      for (const Solved& s : solved) {
        Collisions found;
        variant->build(s.chain);
        variant->find(s.chain, {}, found);
        properties::sort(found.pairs);
        EXPECT_TRUE(found.pairs == s.right.pairs && found.count == s.right.count)
            << name << " on " << hwy::TargetName(target) << ", " << s.name << ": " << found.pairs.size()
            << " pairs, right " << s.right.pairs.size();
      }
    }
    chosen.insert(hwy::GetChosenTarget().GetIndex());
  }
  EXPECT_EQ(chosen.size(), targets.size()) << "one was not forced";
}

/// The same of searches that use what frames have in common.
TEST(SimdTargets, AnswerFrameAfterFrameEachOfThem) {
  const std::vector<Solved> solved = solved_chains();
  const auto subject = properties::Subject::named("auto(frames=always)");
  auto all = properties::PropertyRegistry::instance().make_all();
  const auto frames = std::ranges::find(all, "frame after frame", [](const auto& p) { return p->name(); });
  ASSERT_NE(frames, all.end());
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    const auto variant = subject.make();
    for (const Solved& s : solved) {
      if (s.chain.size() == 0) continue;
      const auto fault = (*frames)->check(subject, *variant, properties::Case::of(s.chain));
      EXPECT_FALSE(fault) << hwy::TargetName(target) << ", " << s.name << ": " << *fault;
    }
  }
}

/// Powers of two leave all digits as they are.
TEST(SimdTargets, LeaveAsMuchOpenWhateverTheScale) {
  properties::Dice dice(1);
  const Chain chain = near_ties(dice, 1500, 1);
  const auto open = [](const char* name, const Chain& of) {
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    variant->build(of);
    variant->find(of, {}, found);
    EXPECT_GT(found.pair_count, 0u);
    const auto work = variant->work();
    const auto step = std::ranges::find(work, "pair of spheres, beyond binary32", &WorkDone::step);
    EXPECT_NE(step, work.end());
    return step == work.end() ? 0 : step->times;
  };
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    for (const char* name : {"ChainTree", "Grid(cells=wide)", "Grid(cells=narrow)", "SphereTree"}) {
      const std::uint64_t here = open(name, chain);
      EXPECT_GT(here, 0u) << name;
      for (const int by : {-120, -60, 60, 90}) {
        std::vector<Sphere> scaled(chain.spheres().begin(), chain.spheres().end());
        for (Sphere& s : scaled)
          s = {std::ldexp(s.x, by), std::ldexp(s.y, by), std::ldexp(s.z, by), std::ldexp(s.radius, by)};
        EXPECT_EQ(open(name, Chain(std::move(scaled))), here)
            << name << " times 2^" << by << " on " << hwy::TargetName(target);
      }
    }
  }
}

/// What is weighed against other searches' steps must be in their unit: half as wide a vector, twice the
/// tests.
TEST(SimdTargets, CountVectorsOfTheirOwnWidth) {
  properties::Dice dice(1);
  const Chain chain(properties::tangle(dice, 2100));
  std::set<std::uint64_t> spheres_tested;
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    const auto variant = StrategyRegistry::instance().make("SphereTree");
    Collisions found;
    variant->build(chain);
    variant->find(chain, {}, found);
    const auto work = variant->work();
    const auto tests = std::ranges::find(work, "sphere, vector of spheres", &WorkDone::step);
    ASSERT_NE(tests, work.end());
    spheres_tested.insert(tests->times * spheres_of_a_vector());
  }
  EXPECT_GT(*spheres_tested.begin(), chain.size());
  EXPECT_LT(*spheres_tested.rbegin(), *spheres_tested.begin() * 1.01) << "boxes differ by a rounding";
}

}  // namespace
}  // namespace catena

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "catena/core/blocks/simd_targets.h"
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

/// A chain of every family, and tangles about the limits of vectors, blocks and nodes.
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
  return solved;
}

/// Machines differ in the best that they have: what another one runs is run here too, as far as this one can.
TEST(SimdTargets, GiveTheExactPairsEachOfThem) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_FALSE(targets.empty());
  const std::vector<Solved> solved = solved_chains();
  EXPECT_TRUE(std::ranges::any_of(solved, [](const Solved& s) { return s.right.pair_count > 1000; }));
  std::set<std::size_t> chosen;
  for (const std::int64_t target : targets) {
    const properties::ForcedTarget forced(target);
    for (const char* name : {"ChainTree", "Grid", "Hybrid", "Hybrid(crowd=0)", "Hybrid(crowd=0,dense=0)",
                             "Hybrid(crowd=0,dense=0.2)", "Hybrid(crowd=0,dense=1e6)"}) {
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
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const properties::ForcedTarget forced(target);
    const auto variant = subject.make();
    for (const Solved& s : solved) {
      if (s.chain.size() == 0) continue;
      const auto fault = (*frames)->check(subject, *variant, properties::Case::of(s.chain));
      EXPECT_FALSE(fault) << hwy::TargetName(target) << ", " << s.name << ": " << *fault;
    }
  }
}

}  // namespace
}  // namespace catena

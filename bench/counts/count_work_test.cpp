#include "catena/bench/counts/count_work.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

Chain chain_of(const std::string& input) { return open_input(input).animation->frame(0); }

VariantInfo named(const std::string& name) {
  for (auto& info : StrategyRegistry::instance().variants())
    if (info.name == name) return info;
  throw InputError(name);
}

std::uint64_t admissible_pairs(const Chain& chain) {
  std::uint64_t pairs = 0;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j) pairs += !chain.neighbours(i, j);
  return pairs;
}

TEST(Work, OfAllPairsIsTheirNumber) {
  for (const char* input : {"path1:n=500", "yarn:n=300", "tight_knot:n=200", "hair:n=400"}) {
    const Chain chain = chain_of(input);
    const std::uint64_t pairs = admissible_pairs(chain);
    const Work once{pairs, 0, pairs * sizeof(Sphere)};
    EXPECT_EQ(count_work(named("CPU1"), chain), once) << input;
    for (const char* rounded : {"CPU1/literal", "CPU1/double"})  // spheres are compared as they are stored
      EXPECT_EQ(count_work(named(rounded), chain), once) << input;
  }
  const Chain path = chain_of("path1:n=500");
  const std::uint64_t both_ends = 2 * admissible_pairs(path);
  EXPECT_EQ(count_work(named("GPU1@host"), path), (Work{both_ends, 0, both_ends * sizeof(Sphere)}));
}

TEST(Work, IsTheSameInEveryRunAndForTheSameSearch) {
  const Chain chain = chain_of("yarn:n=1000");
  for (const auto& info : StrategyRegistry::instance().variants()) {
    if (info.unavailable) continue;
    const auto work = count_work(info, chain);
    EXPECT_EQ(work, count_work(info, chain)) << info.name;
    if (!work || info.all_pairs || info.name == "ResidentBlocks")
      continue;  // all pairs too: an example on a device
    // ChainTree's wide nodes are visited by fewer than one a sphere; a sweep has none.
    const std::uint64_t visits = info.name == "ChainTree" ? chain.size() / 8 : chain.size();
    if (info.name != "SweepAndPrune") {
      EXPECT_GT(work->node_visits, visits) << info.name;
    }
    const std::uint64_t bounds =
        (work->pair_tests + work->node_visits) * (info.arithmetic == "double" && !info.all_pairs ? 32 : 16);
    EXPECT_GE(work->bytes, bounds) << info.name;
    EXPECT_LE(work->bytes, bounds + 8 * work->node_visits) << info.name;
    // The tests' own example of a tree has coarse leaves, of eight spheres.
    const std::uint64_t share = info.name == "Boxes+BoxesAgainstBoxes" ? 2 : 4;
    EXPECT_LT(work->pair_tests, admissible_pairs(chain) / share) << info.name;
  }
  const auto recursive = count_work(named("aCPU2+CPU2"), chain);
  EXPECT_EQ(recursive, count_work(named("aCPU2+GPU2@host"), chain)) << "the same tests in another order";
  EXPECT_EQ(recursive, count_work(named("aCPU2+GPUv2@host"), chain));
}

TEST(Work, OfATreeIsWhatItsShapeSays) {
  // Six spheres in a row, apart: ((1 2)(3 4))(5 6). Each sphere is compared with both children of the root;
  // every bound of a subtree it is not in, and does not reach, is left out there.
  std::vector<Sphere> spheres;
  for (int i = 0; i < 6; ++i) spheres.push_back({static_cast<float>(1000 * i * i), 0, 0, 0.1f});
  const auto work = count_work(named("aCPU2+CPU2"), Chain(std::move(spheres), {}, Exclusion::index(1)));
  ASSERT_TRUE(work);
  // 1 and 2: (1..4), (56), (12), (34) and no leaf but each other, neighbours; 3, 4 likewise; 5 and 6: (1..4),
  // (56).
  EXPECT_EQ(work->node_visits, 4u * 4 + 2 * 2);
  EXPECT_EQ(work->pair_tests, 0u);
  EXPECT_EQ(work->bytes, work->node_visits * sizeof(Sphere) + (4u * 2 + 2 * 1) * 8);
}

TEST(Work, ARefusalIsTold) {
  EXPECT_THROW(count_work(named("bGPU2@host+CPU2"), chain_of("path1:n=5000")), CapacityError);
}

}  // namespace
}  // namespace catena::bench

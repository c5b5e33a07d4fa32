#include "catena/properties/fuzz/fuzzer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/readers/chain_format.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/properties/fuzz/failure_store.h"
#include "catena/properties/fuzz/sequence.h"
#include "catena/properties/generators/mutate.h"
#include "catena/properties/mutants/counted_for.h"
#include "catena/reference/exact_gap.h"

namespace catena::properties {
namespace {

/// All pairs, but for those that only touch: `<` for `<=`. Hidden, so that no other test meets it.
class MissesTouching final : public Variant {
 public:
  void build(const Chain&) override {}
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    PairCollector collector(chain.size(), request, result);
    std::vector<std::uint32_t> counts(chain.size());
    for (std::uint32_t i = 0; i < chain.size(); ++i)
      for (std::uint32_t j = i + 1; j < chain.size(); ++j)
        if (!chain.neighbours(i, j) && reference::gap_sign(chain[i], chain[j]) < 0) {
          collector.lane(0).pair(i, j);
          ++counts[i], ++counts[j];
        }
    for (std::uint32_t i = 0; i < chain.size(); ++i) collector.lane(0).count(i, counts[i]);
    collector.finish();
  }
  Timings timings() const override { return {}; }
};

const test::RegisterHidden<MissesTouching> misses_touching{
    {.name = "MissesTouching", .summary = "`<` for `<=`"}};

std::optional<Fuzzer::Counterexample> fuzz(Fuzzer& fuzzer, std::uint64_t cases) {
  while (fuzzer.cases() < cases)
    if (auto found = fuzzer.step()) return found;
  return std::nullopt;
}

std::string text_of(const Chain& chain) {
  std::ostringstream text;
  write_chain(text, chain);
  return text.str();
}

TEST(Fuzzer, FindsAndShrinksAnError) {
  Fuzzer fuzzer({Subject::named("MissesTouching")}, {});
  const auto found = fuzz(fuzzer, 1000);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.variant, "MissesTouching");
  ASSERT_EQ(found->shrunk.size(), 1u);
  EXPECT_TRUE(found->repeats);
  const Chain& shrunk = found->shrunk.front();
  EXPECT_LE(shrunk.size(), 3u);
  EXPECT_TRUE(fuzzer.suite().repeats(found->finding, shrunk));
  for (const Sphere& s : shrunk.spheres())
    for (const float number : {s.x, s.y, s.z, s.radius})
      EXPECT_TRUE(std::fabs(number) <= 4 && 4 * number == std::round(4 * number)) << text_of(shrunk);
}

TEST(Fuzzer, TheSameSeedGivesTheSameRun) {
  for (const std::uint64_t seed : {3u, 4u}) {
    Fuzzer first({Subject::named("MissesTouching")}, {.seed = seed}),
        second({Subject::named("MissesTouching")}, {.seed = seed});
    const auto a = fuzz(first, 1000), b = fuzz(second, 1000);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->number, b->number);
    EXPECT_EQ(text_of(a->found), text_of(b->found));
    EXPECT_EQ(text_of(a->shrunk.front()), text_of(b->shrunk.front()));
  }
}

TEST(Fuzzer, AnotherSeedGivesOtherChains) {
  std::set<std::string> runs;
  for (const std::uint64_t seed : {0u, 1u, 2u, 3u}) {
    std::string chains;
    Fuzzer fuzzer({Subject::named("CPU1")}, {.seed = seed});
    fuzzer.watch([&](const std::string&, std::uint64_t, const Chain& chain) { chains += text_of(chain); },
                 {});
    EXPECT_FALSE(fuzz(fuzzer, 10));
    runs.insert(chains);
  }
  EXPECT_EQ(runs.size(), 4u);
}

TEST(Fuzzer, FindsNothingInARightVariantAndClimbs) {
  Fuzzer fuzzer({Subject::named("aCPU2+CPU2")}, {.seed = 9});
  EXPECT_FALSE(fuzz(fuzzer, 500));
  const Interest best = fuzzer.pool().best();
  EXPECT_EQ(best.score[0], 7) << "64 leaves by pairs are 7 levels";
  EXPECT_GE(best.score[1], 4) << "spheres that wait";
  EXPECT_GT(best.score[2], 24) << "a margin below one ulp";
  EXPECT_GT(best.score[3], 1000) << "of 2,016 pairs";
  EXPECT_GT(fuzzer.by_family().at("mutated"), 100u);
}

TEST(Fuzzer, OnlyTheFamiliesAskedFor) {
  Fuzzer fuzzer({Subject::named("CPU1")}, {.families = {FamilyRegistry::instance().family("coil")}});
  EXPECT_FALSE(fuzz(fuzzer, 50));
  for (const auto& [family, cases] : fuzzer.by_family())
    EXPECT_TRUE(family == "coil" || family == "mutated") << family;
}

TEST(Fuzzer, AStoredFailureReadsBackAsItsChain) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("catena-failures-" + std::to_string(getpid()));
  Fuzzer fuzzer({Subject::named("MissesTouching")}, {});
  const auto found = fuzz(fuzzer, 1000);
  ASSERT_TRUE(found);
  const auto files = store(folder, *found, 1);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files, store(folder, *found, 1));
  const auto another = store(folder, found->finding, "another", {found->found});
  ASSERT_NE(text_of(found->found), text_of(found->shrunk.front()));
  EXPECT_NE(another, files) << "which stays where it is";
  EXPECT_EQ(text_of(load_chain(files.front())), text_of(found->shrunk.front()));
  std::filesystem::remove_all(folder);
}

TEST(Fuzzer, LongChainsAreFewAndStayOutOfThePool) {
  Fuzzer fuzzer({Subject::named("CPU1")}, {});
  EXPECT_FALSE(fuzz(fuzzer, 4000));
  EXPECT_GT(fuzzer.long_cases(), 5u);
  EXPECT_LT(fuzzer.long_cases(), 40u);
  EXPECT_LE(fuzzer.pool().best().score[0], 7) << "64 leaves by pairs are 7 levels";
  Fuzzer short_only({Subject::named("CPU1")}, {.long_size = 0});
  EXPECT_FALSE(fuzz(short_only, 1000));
  EXPECT_EQ(short_only.long_cases(), 0u);
}

TEST(Fuzzer, MeetsTheGiantsOnce) {
  Fuzzer fuzzer({Subject::named("mutant:16-bit-ids")}, {.shrink = false});
  const auto found = fuzz(fuzzer, 200);
  ASSERT_TRUE(found) << "ids past 16 bits";
  EXPECT_EQ(found->family, "giants");
  EXPECT_GT(found->found.size(), 65'536u);
  Fuzzer right({Subject::named("aCPU2+CPU2")}, {});
  EXPECT_FALSE(right.giants_once());
  const auto chains = right.suite().tally().chains;
  EXPECT_GT(chains, 0u);
  EXPECT_FALSE(right.giants_once());
  EXPECT_EQ(right.suite().tally().chains, chains);
}

/// What fails only after other chains is shown by the fewest of them.
TEST(Fuzzer, ShrinksAFailureThatDependsOnHistoryAsASequence) {
  const std::string name = "mutant:stale-after-a-longer-chain";
  Fuzzer fuzzer({Subject::named(name)}, {});
  const auto found = fuzz(fuzzer, 1000);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->repeats);
  EXPECT_FALSE(fuzzer.suite().repeats(found->finding, found->found)) << "a new object is right";
  ASSERT_EQ(found->shrunk.size(), 2u);
  EXPECT_GT(found->shrunk[0].size(), 4 * found->shrunk[1].size());
  EXPECT_TRUE(fails_in_sequence(Subject::named(name), found->finding.property, found->shrunk));
  EXPECT_FALSE(fails_in_sequence(Subject::named(name), "another property", found->shrunk));

  const auto folder =
      std::filesystem::temp_directory_path() / ("catena-failures-" + std::to_string(getpid()));
  const auto files = store(folder, *found, 1);
  ASSERT_EQ(files.size(), 2u);
  std::vector<Chain> stored;
  for (const auto& file : files) stored.push_back(load_chain(file));
  for (std::size_t k = 0; k < 2; ++k) {
    std::ostringstream text;
    text << std::ifstream(files[k]).rdbuf();
    EXPECT_NE(text.str().find("; chain " + std::to_string(k + 1) + " of 2, by one object"), std::string::npos)
        << text.str();
  }
  EXPECT_TRUE(fails_in_sequence(Subject::named(name), found->finding.property, stored));
  std::filesystem::remove_all(folder);
}

/// Once there is `that`: counts a pair too many of all other chains, where it has met it.
class WrongAfterAChain final : public Variant {
 public:
  void build(const Chain& chain) override {
    met_[mark_of(chain)] = true;
    right_->build(chain);
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    right_->find(chain, request, result);
    if (result.pair_count > 0 && that && met_[*that] && mark_of(chain) != *that) ++result.pair_count;
  }
  Timings timings() const override { return {}; }

  static inline std::optional<std::size_t> that;
  static std::size_t mark_of(const Chain& chain) {
    const auto* const bytes = reinterpret_cast<const char*>(chain.spheres().data());
    return std::hash<std::string_view>()({bytes, chain.spheres().size_bytes()}) % marks;
  }

 private:
  static constexpr std::size_t marks = std::size_t{1} << 22;  // so many that no two chains share one
  std::vector<bool> met_ = std::vector<bool>(marks);
  std::unique_ptr<Variant> right_ = StrategyRegistry::instance().make("CPU1");
};

const test::RegisterHidden<WrongAfterAChain> wrong_after_a_chain{
    {.name = "WrongAfterAChain", .summary = "wrong after a chain"}};

/// However many were drawn before.
TEST(Fuzzer, RemembersTheLatestChains) {
  WrongAfterAChain::that.reset();
  Fuzzer fuzzer({Subject::named("WrongAfterAChain")}, {.long_size = 0});
  std::size_t last = 0;
  fuzzer.watch(
      [&](const std::string&, std::uint64_t, const Chain& chain) { last = WrongAfterAChain::mark_of(chain); },
      {});
  EXPECT_FALSE(fuzz(fuzzer, 70));
  WrongAfterAChain::that = last;
  const auto found = fuzz(fuzzer, 95);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->repeats);
  ASSERT_EQ(found->shrunk.size(), 2u);
  EXPECT_EQ(WrongAfterAChain::mark_of(found->shrunk[0]), WrongAfterAChain::that);
  WrongAfterAChain::that.reset();
}

/// Counts a pair too many, once in a process: no new object does so again.
class WrongOnce final : public Variant {
 public:
  void build(const Chain&) override {}
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    const auto right = StrategyRegistry::instance().make("CPU1");
    right->build(chain);
    right->find(chain, request, result);
    if (result.pair_count == 0 || done) return;
    done = true;
    ++result.pair_count;
  }
  Timings timings() const override { return {}; }
  static inline bool done = false;
};

const test::RegisterHidden<WrongOnce> wrong_once{{.name = "WrongOnce", .summary = "wrong once"}};

TEST(Fuzzer, SaysWhatDoesNotRepeat) {
  WrongOnce::done = false;
  Fuzzer fuzzer({Subject::named("WrongOnce")}, {});
  const auto found = fuzz(fuzzer, 1000);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->repeats);
  ASSERT_EQ(found->shrunk.size(), 1u);
  EXPECT_EQ(text_of(found->shrunk[0]), text_of(found->found)) << "there is nothing to shrink it by";
}

TEST(Fuzzer, SaysWhatNoNewObjectShows) {
  EXPECT_FALSE(shortest_sequence(Subject::named("aCPU2+CPU2"), "pair set",
                                 {Chain({{0, 0, 0, 1}}), Chain({{0, 0, 0, 1}, {1, 0, 0, 1}})}));
}

/// Whatever order they come in, those that score less than many others are forgotten.
TEST(Pool, PicksFromTheBestFew) {
  constexpr std::size_t all = 30;
  for (const bool rising : {true, false}) {
    Pool pool;
    for (std::size_t k = 1; k <= all; ++k) {
      const std::size_t n = rising ? k : all + 1 - k;
      Interest interest;
      interest.score.fill(static_cast<double>(n));
      pool.offer(Chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1})), interest);
    }
    Dice dice(1);
    std::set<std::uint32_t> sizes;
    for (int k = 0; k < 1000; ++k) sizes.insert(pool.pick(dice).size());
    EXPECT_EQ(*sizes.rbegin(), all);
    EXPECT_EQ(*sizes.rbegin() - *sizes.begin() + 1, sizes.size()) << "none is skipped";
    EXPECT_TRUE(sizes.size() > 3 && sizes.size() < 12) << sizes.size();
  }
}

/// Of five spheres the tree is as deep as that of the first four, and one.
TEST(Fuzzer, MeasuresATreeAtItsDeepestAndAMarginByItsExponent) {
  const auto tree = StrategyRegistry::instance().make("aCPU2+CPU2");
  InterestMeter meter(*tree);
  const Chain chain({{0, 0, 0, 1}, {9, 0, 0, 1}, {1, 0, 0, 1}, {99, 0, 0, 1}, {9, 1, 0, 1}});
  for (const auto& [margin, tightness] :
       {std::pair(0x1p-20, 20.0), {0.0, 0.0}, {4.0, 0.0}, {HUGE_VAL, 0.0}}) {
    const Interest found = meter.of(Case::of(chain), margin);
    EXPECT_EQ(found.score[0], 4);
    EXPECT_EQ(found.score[2], tightness) << margin;
    EXPECT_EQ(found.score[3], 2);
  }
}

/// A long chain, then a short one: which of them, and of how many spheres, is found.
TEST(Fuzzer, LeavesOfASequenceTheSimplestOfWhatItNeeds) {
  const auto fails = [](const std::vector<Chain>& chains) {
    bool met = false;
    for (const Chain& chain : chains) {
      if (met && chain.size() > 3 && chain.size() < 8) return true;
      met |= chain.size() > 20;
    }
    return false;
  };
  std::vector<Chain> chains;
  for (const std::size_t n : {5, 30, 9, 27, 6, 2})
    chains.emplace_back(std::vector<Sphere>(n, Sphere{3, 4, 5, 1}));
  const auto left = shortest_sequence(chains, fails);
  ASSERT_TRUE(left.has_value());
  ASSERT_EQ(left->size(), 2u);
  EXPECT_EQ((*left)[0].size(), 21u);
  EXPECT_EQ((*left)[1].size(), 4u);
}

TEST(Fuzzer, KillsEveryMutantWithinItsBudget) {
  constexpr std::uint64_t budget = 20'000;  // chains
  // It loses what touches by less than binary32 can see, along straight lines: chains that are made for it
  // kill it (Mutants.AllDie), and chance meets none.
  const std::set<std::string> never_by_chance{"mutant:order-without-slack"};
  std::multimap<std::uint64_t, std::string> late;
  for (const Subject& mutant : Subject::available(true)) {
    if (!mutant.info.name.starts_with("mutant:") || never_by_chance.contains(mutant.info.name)) continue;
    const CountedFor counted(mutant.info.name);
    Fuzzer fuzzer({mutant}, {.shrink = false});
    const bool found = fuzz(fuzzer, budget).has_value();
    EXPECT_TRUE(found) << mutant.info.name << " survives " << budget << " chains";
    if (found && fuzzer.cases() > 300) late.emplace(fuzzer.cases(), mutant.info.name);
  }
  for (const auto& [cases, name] : late) std::cout << name << " dies after " << cases << " chains\n";
}

TEST(Mutation, KeepsAChainAChain) {
  for (const Family& family : FamilyRegistry::instance().families()) {
    Dice dice(5);
    Chain chain = generate(family, dice, 30);
    for (int round = 0; round < 300; ++round) {
      chain = mutate(chain, dice, 30);
      ASSERT_GE(chain.size(), 1u);
      ASSERT_LE(chain.size(), 30u);
    }
  }
}

}  // namespace
}  // namespace catena::properties

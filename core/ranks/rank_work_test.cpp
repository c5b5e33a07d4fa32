// What ranks say of how they went about a search, and what they ask of a variant.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/ranks/local_search.h"
#include "catena/core/ranks/phase_clock.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/ranks/test_chain.h"
#include "catena/core/ranks/thread_ranks.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/reference.h"

namespace catena::ranks {
namespace {

struct Searched {
  std::vector<RankAnswer> answers;
  std::vector<RankWork> work;
  template <class Number>
  std::uint64_t sum(const Number& number) const {
    std::uint64_t sum = 0;
    for (const RankWork& of : work) sum += number(of);
    return sum;
  }
};

Searched searched(unsigned ranks, const Chain& chain, const RankOptions& options) {
  Searched all{std::vector<RankAnswer>(ranks), std::vector<RankWork>(ranks)};
  run_in_threads(ranks, [&](Communicator& c) {
    all.answers[c.rank()] = search(c, even_part_of(chain, ranks, c.rank()), options, all.work[c.rank()]);
  });
  return all;
}

TEST(RankWork, IsPartedAsToldOrAsWhatTouchesSays) {
  const Chain rod = chain_of("rod:n=4000"), yarn = chain_of("yarn:n=4000");
  for (const unsigned ranks : {2u, 4u}) {
    const auto in_space = [&](const Chain& chain, Order order) {
      const Searched all = searched(ranks, chain, {.order = order});
      for (const RankWork& work : all.work) EXPECT_EQ(work.in_space, all.work[0].in_space);
      return all.work[0].in_space;
    };
    EXPECT_TRUE(in_space(rod, Order::space));
    EXPECT_FALSE(in_space(rod, Order::chain));
    EXPECT_FALSE(in_space(rod, Order::measured)) << "little touches";
    EXPECT_FALSE(in_space(yarn, Order::chain));
    EXPECT_TRUE(in_space(yarn, Order::measured)) << "much touches";
  }
}

/// However small the rounds are, the same blocks are asked for, and the same of them touch.
TEST(RankWork, IsTheSameInRoundsOfAnySize) {
  const Chain yarn = chain_of("yarn:n=3000");
  for (const Order order : {Order::chain, Order::space})
    for (const unsigned ranks : {2u, 5u}) {
      const Searched whole = searched(ranks, yarn, {.order = order});
      for (const std::uint32_t at_once : {1u, 3u, 40u}) {
        const Searched parts = searched(ranks, yarn, {.order = order, .blocks_at_once = at_once});
        for (unsigned r = 0; r < ranks; ++r) {
          const AcrossWork &a = whole.work[r].across, &b = parts.work[r].across;
          EXPECT_EQ(a.blocks_told, b.blocks_told) << ranks << ' ' << at_once;
          EXPECT_EQ(a.blocks_asked, b.blocks_asked) << ranks << ' ' << at_once;
          EXPECT_EQ(a.blocks_touching, b.blocks_touching) << ranks << ' ' << at_once;
          EXPECT_GE(b.rounds, a.rounds);
        }
      }
    }
}

/// Where only whether anything collides is asked, what is found ends it.
TEST(RankWork, EndsWithTheFirstPairWhereNoMoreIsAsked) {
  const Chain yarn = chain_of("yarn:n=3000");
  const auto rounds = [&](Request::Want want) {
    const RankOptions options{
        .order = Order::chain, .request = {.want = want}, .blocks_at_once = 1, .across_only = true};
    return searched(3, yarn, options).sum([](const RankWork& w) { return w.across.rounds; });
  };
  EXPECT_LT(2 * rounds(Request::Want::any), rounds(Request::Want::counts));
}

/// Of two parts in chain order alone.
TEST(RankWork, IsAcrossRanksOnlyWhereNoMoreIsAsked) {
  const Chain yarn = chain_of("yarn:n=3000");
  const Searched across = searched(3, yarn, {.order = Order::chain, .across_only = true});
  const auto rank_of = [](std::uint32_t sphere) { return sphere / 1000; };
  std::uint64_t right = 0;
  for (const Pair& pair : reference::find(yarn).pairs) right += rank_of(pair.i) != rank_of(pair.j);
  ASSERT_GT(right, 100u);
  EXPECT_EQ(across.answers[0].pair_count, right);
  EXPECT_EQ(across.sum([](const RankWork& w) { return w.pairs_across; }), right);
  EXPECT_EQ(across.sum([](const RankWork& w) { return w.pairs_within; }), 0u);
}

TEST(RankWork, CountsNothingWhereOnlyWhetherAnythingCollidesIsAsked) {
  for (const char* input : {"yarn:n=1500", "rod:n=500", "coincident:n=60"}) {
    const Chain chain = chain_of(input);
    const bool collides = reference::find(chain).pair_count > 0;
    for (const unsigned ranks : {1u, 3u})
      for (const Order order : {Order::chain, Order::space}) {
        const Searched all =
            searched(ranks, chain, {.order = order, .request = {.want = Request::Want::any}});
        for (const RankAnswer& answer : all.answers) {
          EXPECT_EQ(answer.found, collides) << input;
          EXPECT_EQ(answer.pair_count, 0u) << input;
          EXPECT_TRUE(answer.count.empty() && answer.pairs.empty()) << input;
        }
      }
  }
}

/// Says how often it was asked, and the most pairs that it gave at once.
class Asked final : public Variant {
 public:
  void build(const Chain& chain) override { whole_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    ++times;
    whole_->find(chain, request, found);
    most = std::max(most, found.pairs.size());
  }
  Timings timings() const override { return {}; }

  std::size_t times = 0, most = 0;

 private:
  std::unique_ptr<Variant> whole_ = StrategyRegistry::instance().make("CPU1");
};

TEST(LocalSearch, VisitsEachPairOnceInFewSearchesHoweverFewAreHeldAtOnce) {
  for (const char* input : {"winding:n=90,contacts=20", "coincident:n=90"}) {
    const Chain chain = chain_of(input);
    const std::vector<Pair> all = reference::find(chain).pairs;
    for (const SphereRange range : {SphereRange{0, 90}, SphereRange{13, 76}, SphereRange{5, 6}})
      for (const std::uint64_t at_once : {1u, 2u, 7u, 90u, 2000u}) {
        Asked variant;
        variant.build(chain);
        std::vector<Pair> visited, right;
        for_each_pair(
            variant, chain, range, [&](const Pair& pair) { visited.push_back(pair); }, at_once);
        for (const Pair& pair : all)
          if (range.contains(pair.i)) right.push_back(pair);
        std::ranges::sort(visited);
        EXPECT_EQ(visited, right) << input << at_once;
        EXPECT_GT(right.size(), 5u);
        EXPECT_LE(variant.times, right.size() <= at_once ? 1u : 12u) << input << at_once;
        // A sphere alone may have more.
        EXPECT_LE(variant.most, std::max<std::size_t>({at_once, right.size() / 2, 90})) << input << at_once;
      }
  }
}

TEST(PhaseClock, RunsUntilDone) {
  PhaseClock clock;
  const auto pass = [](int ms) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
    while (std::chrono::steady_clock::now() < end) {
    }
  };
  const auto ms = [&](Phase phase) { return clock.ms()[static_cast<std::size_t>(phase)]; };
  clock.enter(Phase::build);
  pass(3);
  clock.enter(Phase::within);
  pass(2);
  clock.enter(Phase::done);
  pass(2);
  clock.enter(Phase::build);
  pass(1);
  clock.enter(Phase::done);
  EXPECT_GE(ms(Phase::build), 4);
  EXPECT_GE(ms(Phase::within), 2);
  EXPECT_EQ(ms(Phase::done), 0) << "what passes between two searches is of none";
  EXPECT_EQ(ms(Phase::order), 0);
  for (std::size_t k = 0; k < PhaseClock::phases; ++k)
    EXPECT_LE(clock.processor_ms()[k], clock.ms()[k] + 50);
}

}  // namespace
}  // namespace catena::ranks

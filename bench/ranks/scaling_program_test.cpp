#include <algorithm>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "catena/bench/ranks/scaling.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"
#include "catena/core/plan/find.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

/// `catena scaling`, held against what was counted; and that against what each rank counted.
class ScalingProgram : public Program {};

TEST_F(ScalingProgram, TellsWhatWasCounted) {
  const Chain chain = open_input("yarn:n=3000").animation->frame(0);
  for (const std::string order : {"chain", "space"}) {
    const auto json =
        nlohmann::json::parse(run("scaling yarn:n=3000 --ranks 64 --json --order " + order).output);
    const Scaling scaling =
        measure_scaling(chain, {.ranks = {2, 4, 8, 16, 32, 64}, .order = parts::order_named(order)});
    ASSERT_EQ(json["points"].size(), scaling.points.size());
    for (std::size_t k = 0; k < scaling.points.size(); ++k) {
      const ScalingPoint& p = scaling.points[k];
      EXPECT_EQ(json["points"][k], nlohmann::json({{"ranks", p.ranks},
                                                   {"order", order},
                                                   {"blocks", p.blocks},
                                                   {"most_spheres", p.most_spheres},
                                                   {"most_partners", p.most_partners},
                                                   {"most_rounds", p.most_rounds},
                                                   {"blocks_told", p.blocks_told},
                                                   {"blocks_asked", p.blocks_asked},
                                                   {"blocks_touching", p.blocks_touching},
                                                   {"most_blocks_asked", p.most_blocks_asked},
                                                   {"bytes", p.bytes},
                                                   {"most_bytes", p.most_bytes},
                                                   {"messages", p.messages},
                                                   {"most_messages", p.most_messages},
                                                   {"pairs_across", p.pairs_across}}));
      EXPECT_GE(p.most_spheres, (3000 + p.ranks - 1) / p.ranks) << "of the rank that has most";
      EXPECT_GE(p.blocks_told, p.blocks_asked);
      EXPECT_GE(p.most_blocks_asked * p.ranks, p.blocks_asked);
      EXPECT_LE(p.most_blocks_asked, p.blocks_asked);
      EXPECT_GT(p.bytes, p.messages) << "a message has some bytes";
      EXPECT_LT(p.most_messages, p.messages);
    }
    EXPECT_EQ(json["stops_at"], scaling.stops_at());
    const auto law = scaling.surface();
    EXPECT_EQ(law.has_value(), order == "space");
    EXPECT_EQ(json.value("surface", nlohmann::json()),
              law ? nlohmann::json({{"exponent", law->exponent}, {"low", law->low}, {"high", law->high}})
                  : nlohmann::json());
  }
}

TEST(ScalingPoint, IsTheSumAndTheMostOfWhatEachRankCounted) {
  for (const auto& [scene, order] : {std::pair("yarn:n=2000", Order::chain),
                                     {"yarn:n=2000", Order::space},
                                     {"rod:n=2000", Order::chain}})  // of which the last rank has one partner
    for (const unsigned ranks : {2u, 5u}) {
      const Chain chain = open_input(scene).animation->frame(0);
      std::vector<RankWork> work(ranks);
      std::vector<Traffic> sent(ranks);
      run_in_threads(ranks, [&](Communicator& c) {
        const RankOptions options{
            .order = order, .request = {.want = Request::Want::counts}, .across_only = true};
        search(c, even_part_of(chain, ranks, c.rank()), options, work[c.rank()]);
        sent[c.rank()] = c.traffic();
      });
      const auto sum = [](const auto& of, const auto& number) {
        return std::transform_reduce(of.begin(), of.end(), std::uint64_t{0}, std::plus<>(), number);
      };
      const auto most = [](const auto& of, const auto& number) {
        return number(std::ranges::max(of, {}, number));
      };
      const auto asked = [](const RankWork& w) { return w.across.blocks_asked; };
      const auto bytes = [](const Traffic& t) { return t.bytes; };
      const auto messages = [](const Traffic& t) { return t.messages; };
      const ScalingPoint p = measure_scaling(chain, {.ranks = {ranks}, .order = order}).points[0];
      EXPECT_EQ(p.blocks, sum(work, [](const RankWork& w) { return w.blocks; }));
      EXPECT_EQ(p.most_spheres, most(work, [](const RankWork& w) { return w.spheres; }));
      EXPECT_EQ(p.most_partners, most(work, [](const RankWork& w) { return w.across.partners; }));
      EXPECT_EQ(p.most_rounds, most(work, [](const RankWork& w) { return w.across.rounds; }));
      EXPECT_EQ(p.blocks_told, sum(work, [](const RankWork& w) { return w.across.blocks_told; }));
      EXPECT_EQ(p.blocks_touching, sum(work, [](const RankWork& w) { return w.across.blocks_touching; }));
      EXPECT_EQ(p.blocks_asked, sum(work, asked));
      EXPECT_EQ(p.most_blocks_asked, most(work, asked));
      EXPECT_EQ(p.bytes, sum(sent, bytes));
      EXPECT_EQ(p.most_bytes, most(sent, bytes));
      EXPECT_EQ(p.messages, sum(sent, messages));
      EXPECT_EQ(p.most_messages, most(sent, messages));
      EXPECT_EQ(p.pairs_across, sum(work, [](const RankWork& w) { return w.pairs_across; }));
    }
}

/// Of points that are made: each of 2^k ranks asks for h^(2/3) of the h blocks that it holds.
TEST(Scaling, KnowsItsLawAndWhereItStops) {
  Scaling scaling;
  for (unsigned k = 1; k < 6; ++k)
    scaling.points.push_back({.ranks = 1u << k,
                              .in_space = true,
                              .blocks = (1ull << k) << 3 * k,
                              .blocks_asked = (1ull << k) << 2 * k,
                              .most_blocks_asked = 1ull << 2 * k});
  ASSERT_TRUE(scaling.surface());
  EXPECT_NEAR(scaling.surface()->exponent, 2.0 / 3, 1e-9);
  // An even share of less than one block has no logarithm, and parts in chain order have no surface.
  scaling.points.push_back({.ranks = 8, .in_space = true, .blocks = 80, .blocks_asked = 7});
  scaling.points.push_back({.ranks = 8, .in_space = false, .blocks = 80, .blocks_asked = 8000});
  EXPECT_NEAR(scaling.surface()->exponent, 2.0 / 3, 1e-9);
  EXPECT_EQ(scaling.stops_at(), 0u);
  scaling.points.push_back({.ranks = 8, .blocks = 80, .most_blocks_asked = 10});
  EXPECT_EQ(scaling.stops_at(), 0u) << "as many as it holds";
  scaling.points.push_back({.ranks = 16, .blocks = 80, .most_blocks_asked = 6});
  EXPECT_EQ(scaling.stops_at(), 16u);
}

TEST(Scaling, TimesWhatThreadsComputeWithoutTheirWaiting) {
  const Chain chain = open_input("yarn:n=500").animation->frame(0);
  const std::clock_t before = std::clock();  // of the processor, by all threads
  const Scaling scaling = measure_scaling(chain, {.ranks = {16}, .timed_variant = "CPU1"});
  const double used_ms = 1e3 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  const auto& ms = scaling.points[0].all_ms;
  EXPECT_LE(std::accumulate(ms.begin(), ms.end(), 0.0), used_ms + 1);
}

TEST_F(ScalingProgram, TellsTimesWhereTheyAreAskedFor) {
  const auto json = nlohmann::json::parse(run("scaling yarn:n=3000 --ranks 4 --timed Hybrid --json").output);
  ASSERT_EQ(json["points"].size(), 3u);
  EXPECT_EQ(json["points"][0]["ranks"], 1) << "what one alone takes, too";
  const std::uint64_t pairs = catena::find(open_input("yarn:n=3000").animation->frame(0)).pair_count;
  for (const auto& point : json["points"]) {
    EXPECT_EQ(point["pairs"], pairs);
    EXPECT_EQ(point["processor_ms"].size(), PhaseClock::phases - 1);
    double all = 0, most = 0;
    for (const auto& [phase, ms] : point["processor_ms"].items()) {
      EXPECT_GE(ms, point["most_processor_ms"][phase]);
      EXPECT_LE(ms,
                point["most_processor_ms"][phase].get<double>() * point["ranks"].get<double>() * (1 + 1e-9));
      all += ms.get<double>(), most += point["most_processor_ms"][phase].get<double>();
    }
    EXPECT_GT(all, 0);
    EXPECT_EQ(most<all, point["ranks"]> 1) << point;
  }
  EXPECT_EQ(run("scaling yarn:n=300 --ranks 2 --json").output.find("processor_ms"), std::string::npos);
}

TEST_F(ScalingProgram, SaysFromWhereOnOneAsksForMoreThanItHolds) {
  const Chain chain = open_input("yarn:n=1000").animation->frame(0);
  const Scaling scaling = measure_scaling(chain, {.ranks = doubled_ranks(64), .order = Order::space});
  const unsigned stops = scaling.stops_at();
  ASSERT_GT(stops, 0u);
  const std::string told = run("scaling yarn:n=1000 --ranks 64 --order space").output;
  const auto says = [&](const std::string& line) {
    EXPECT_NE(told.find(line), std::string::npos) << line << told;
  };
  says(fmt::format("from {} ranks on, one asks for more blocks than it holds\n", stops));
  const auto law = scaling.surface();
  ASSERT_TRUE(law);
  says(fmt::format("(blocks held)^{:.2f}, between {:.2f} and {:.2f}\n", law->exponent, law->low, law->high));
  for (const ScalingPoint& p : scaling.points)
    says(fmt::format("\n{:>6} {:>6} {:>10} {:>9} {:>7} {:>8} {:>7.2f} {:>12} {:>9}\n", p.ranks, "space",
                     p.most_spheres, p.most_partners, p.most_rounds, p.most_blocks_asked,
                     static_cast<double>(p.blocks_asked) / static_cast<double>(p.blocks_touching),
                     p.most_bytes, p.most_messages));
  EXPECT_EQ(run("scaling rod:n=3000 --ranks 2").output.find("ranks on"), std::string::npos);
  EXPECT_EQ(doubled_ranks(64), (std::vector<unsigned>{2, 4, 8, 16, 32, 64}));
  const std::string orphan = write("orphan.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 9\n");
  const std::string said = run("detect " + orphan).output;
  expect_says("scaling " + orphan + " --ranks 2", 0, {said.substr(said.find("catena: "))});
}

}  // namespace
}  // namespace catena::ranks

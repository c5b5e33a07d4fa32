#include <nlohmann/json.hpp>

#include "catena/bench/ranks/scaling.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"

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
                                                   {"boxes_seen", p.boxes_seen},
                                                   {"blocks_asked", p.blocks_asked},
                                                   {"blocks_touching", p.blocks_touching},
                                                   {"most_blocks_asked", p.most_blocks_asked},
                                                   {"bytes", p.bytes},
                                                   {"most_bytes", p.most_bytes},
                                                   {"messages", p.messages},
                                                   {"most_messages", p.most_messages},
                                                   {"pairs_across", p.pairs_across}}));
      EXPECT_GE(p.most_spheres, (3000 + p.ranks - 1) / p.ranks) << "of the rank that has most";
      EXPECT_GE(p.boxes_seen, p.blocks_asked);
      EXPECT_GE(p.most_blocks_asked * p.ranks, p.blocks_asked);
      EXPECT_LE(p.most_blocks_asked, p.blocks_asked);
      EXPECT_GT(p.bytes, p.messages) << "a message has some bytes";
      EXPECT_LT(p.most_messages, p.messages);
    }
    EXPECT_EQ(json["stops_at"], scaling.stops_at());
    EXPECT_EQ(json.contains("surface"), order == "space");
  }
}

TEST_F(ScalingProgram, TellsTimesWhereTheyAreAskedFor) {
  const auto json = nlohmann::json::parse(run("scaling yarn:n=3000 --ranks 4 --timed Hybrid --json").output);
  ASSERT_EQ(json["points"].size(), 3u);
  EXPECT_EQ(json["points"][0]["ranks"], 1) << "what one alone takes, too";
  for (const auto& point : json["points"]) {
    EXPECT_EQ(point["pairs"], json["points"][0]["pairs"]);
    EXPECT_EQ(point["processor_ms"].size(), PhaseClock::phases - 1);
    double all = 0, most = 0;
    for (const auto& [phase, ms] : point["processor_ms"].items()) {
      EXPECT_GE(ms, point["most_processor_ms"][phase]);
      all += ms.get<double>(), most += point["most_processor_ms"][phase].get<double>();
    }
    EXPECT_GT(all, 0);
    EXPECT_LE(most, all);
  }
  EXPECT_EQ(run("scaling yarn:n=300 --ranks 2 --json").output.find("processor_ms"), std::string::npos);
}

TEST_F(ScalingProgram, SaysFromWhereOnOneAsksForMoreThanItHolds) {
  const Chain chain = open_input("yarn:n=1000").animation->frame(0);
  const unsigned stops = measure_scaling(chain, {.ranks = doubled_ranks(64)}).stops_at();
  ASSERT_GT(stops, 0u);
  expect_says("scaling yarn:n=1000 --ranks 64", 0,
              {"from " + std::to_string(stops) + " ranks on, one asks for more blocks than it holds\n"});
  EXPECT_EQ(run("scaling rod:n=3000 --ranks 2").output.find("ranks on"), std::string::npos);
  EXPECT_EQ(doubled_ranks(64), (std::vector<unsigned>{2, 4, 8, 16, 32, 64}));
  const std::string orphan = write("orphan.swc", "1 1 0 0 0 1 -1\n2 1 5 0 0 1 9\n");
  const std::string said = run("detect " + orphan).output;
  expect_says("scaling " + orphan + " --ranks 2", 0, {said.substr(said.find("catena: "))});
}

}  // namespace
}  // namespace catena::ranks

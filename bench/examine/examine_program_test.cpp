#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "catena/bench/examine/examine.h"
#include "catena/bench/examine/json.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

struct Examined {
  explicit Examined(const std::string& spec, const std::string& arithmetic) {
    const Input input = open_input(spec);
    const Chain chain = input.animation->frame(input.animation->frames() / 2);
    exact = reference::find(chain);
    e = examine(arithmetic, chain, exact);
    auto told = to_json(spec, arithmetic, exact, e);
    told["frame"] = input.animation->frames() / 2;
    line = told.dump();
  }
  reference::Answer exact;
  Examination e;
  std::string line;
};

TEST(ExamineJson, SaysEachNumberUnderItsName) {
  reference::Answer exact;
  exact.count.resize(5);
  exact.pair_count = 7;
  const double infinity = std::numeric_limits<double>::infinity();
  const Examination e{{{1, 3, 2, 0.25}, {2, 1, 0, infinity}}, {0, 4, 2, 0.5}, 6, 3, 1};
  EXPECT_EQ(
      to_json("a", "double", exact, e).dump(),
      R"({"input":"a","n":5,"arithmetic":"double","exact_pairs":7,"parents":4,"failing":2,"worst_shortfall":0.5,)"
      R"("missing":6,"lost_by_tree":3,"invented":1,"levels":[)"
      R"({"level":1,"parents":3,"failing":2,"worst_shortfall":0.25},)"
      R"({"level":2,"parents":1,"failing":0,"worst_shortfall":"infinite"}]})");
}

class ExamineProgram : public Program {};

TEST_F(ExamineProgram, TellsALineForEachInputAndArithmetic) {
  const ProgramOutcome both = run("examine coincident:n=60 path1:n=300 --json");
  EXPECT_EQ(both.code, 0);
  EXPECT_EQ(lines_of(both.output),
            (Texts{Examined("coincident:n=60", "literal").line, Examined("coincident:n=60", "double").line,
                   Examined("path1:n=300", "literal").line, Examined("path1:n=300", "double").line}));
  EXPECT_NE(Examined("path1:n=300", "literal").exact.pair_count,
            Examined("path1:n=300,frame=0", "literal").exact.pair_count)
      << "of the frame in the middle";
  const ProgramOutcome one = run("examine path1:n=300,frame=5 --arithmetic double --json");
  EXPECT_EQ(nlohmann::json::parse(one.output)["frame"], 5) << "of the scene: " << one.output;
  EXPECT_EQ(lines_of(run("examine coincident:n=60 --arithmetic double --json").output),
            Texts{Examined("coincident:n=60", "double").line});
}

TEST_F(ExamineProgram, HasARowForEachAndForEachLevelThatIsAsked) {
  const auto share = [](const LevelExamined& level) {
    return fmt::format("{:.2f}",
                       100.0 * static_cast<double>(level.failing) / static_cast<double>(level.parents));
  };
  const auto shortfall = [](const LevelExamined& level) {
    return fmt::format("{:.1e}", level.worst_shortfall);
  };
  for (const std::string spec : {"coincident:n=60", "rod:n=300"}) {
    const auto [exact, e, line] = Examined(spec, "literal");
    const Texts row{spec,
                    "literal",
                    "all",
                    std::to_string(e.all.parents),
                    share(e.all),
                    "%",
                    shortfall(e.all),
                    std::to_string(exact.pair_count),
                    std::to_string(e.missing),
                    std::to_string(e.lost_by_tree),
                    std::to_string(e.invented)};
    const Texts short_table = lines_of(run("examine " + spec + " --arithmetic literal").output),
                table = lines_of(run("examine " + spec + " --arithmetic literal --levels").output);
    ASSERT_EQ(short_table.size(), 5u) << "heads, a row, and what they mean behind an empty line";
    EXPECT_EQ(words_of(short_table[0])[0], "input");
    EXPECT_EQ(words_of(short_table[1]), row);
    ASSERT_EQ(table.size(), 5 + e.levels.size());
    EXPECT_EQ(words_of(table[1]), row);
    for (std::size_t k = 0; k < e.levels.size(); ++k)
      EXPECT_EQ(words_of(table[2 + k]), (Texts{std::to_string(k + 1), std::to_string(e.levels[k].parents),
                                               share(e.levels[k]), "%", shortfall(e.levels[k])}));
  }
}

TEST_F(ExamineProgram, SaysWhatWasNotReadAndRefusesWhatItDoesNotKnow) {
  expect_says("examine " + write("a.csv", "x,y,z,r,p\n0,0,0,1,7\n"), 0, {"not read: column 'p'"});
  expect_refused("examine rod:n=50 --arithmetic robust", "--arithmetic");
}

}  // namespace
}  // namespace catena::bench

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/bench/knots/judge_knot.h"
#include "catena/bench/knots/known_knots.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena knots`, held against its verdicts.
class KnotsProgram : public Program {
 protected:
  static void expect_told(const nlohmann::json& json, const KnotVerdict& v) {
    EXPECT_EQ(json["knot"], v.published.name);
    EXPECT_EQ(json["of"], words_of(v.published.of));
    EXPECT_EQ(json["source"], v.published.source);
    EXPECT_EQ(json["n"], v.vertices);
    EXPECT_EQ(json["length"], v.shape.length);
    EXPECT_EQ(json["longest_edge"], v.shape.longest_edge);
    EXPECT_EQ(json["published"]["ropelength"], v.bounds.ropelength);
    EXPECT_EQ(json["published"]["thickness"], v.bounds.thickness);
    EXPECT_EQ(json["published"].contains("struts"), v.published.struts > 0);
    ASSERT_EQ(json.contains("first_contact"), v.contact.has_value());
    if (v.contact) {
      EXPECT_EQ(json["first_contact"]["radius"], v.contact->radius);
      EXPECT_EQ(json["first_contact"]["pair"], (nlohmann::json{v.contact->pair.i, v.contact->pair.j}));
    }
    EXPECT_EQ(json["least"], v.bounds.least);
    EXPECT_EQ(json["most"], v.bounds.most);
    EXPECT_EQ(json["ropelength"], v.ropelength());
    EXPECT_EQ(json["contacts"], v.contacts);
    EXPECT_EQ(json["contacts_at_most"], v.contacts_at_most);
    EXPECT_EQ(json["fault"], v.fault());
  }
  nlohmann::json told(const std::string& arguments) const {
    const std::string output = run("knots --variant CPU1 --json " + arguments).output;
    return nlohmann::json::parse(output.substr(0, output.find('\n')));  // warnings follow
  }
};

TEST_F(KnotsProgram, TellsTheVerdictOfEveryLinkThatIsCarried) {
  const auto variant = StrategyRegistry::instance().make("CPU1");
  std::istringstream lines(run("knots --n 17 --variant CPU1 --json").output);
  std::string line;
  for (const KnownKnot& knot : carried_knots(17)) {
    ASSERT_TRUE(std::getline(lines, line));
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["input"], knot.input);
    expect_told(json, judge_knot(*variant, knot.published, knot.centres, knot.blur));
  }
  EXPECT_FALSE(std::getline(lines, line)) << line;
  EXPECT_EQ(carried_knots(17)[2].centres.size(), 8u * 18) << "an even number of each circle";
}

/// A thickness is no ropelength; what reading rounded is of the bounds.
TEST_F(KnotsProgram, TakesTheNumberThatIsTold) {
  const std::string polygon = write("far.csv",
                                    "id,x,y,z,closed\np,100000000.3,0,0,1\np,100000900.3,0,0,1\nq,100000900."
                                    "3,900,0,1\nr,100000000.3,900,0,1\n");
  const Input input = open_input(file("far.csv"), {.centres_only = true});
  ASSERT_GT(input.rounding, 0.2);
  const auto variant = StrategyRegistry::instance().make("CPU1");
  const PublishedKnot thick{.name = "told", .what = "as told", .thickness = 400, .source = "the caller"},
      roped{.name = "told", .what = "as told", .ropelength = 9, .source = "the caller"};
  const double blur = std::sqrt(3.0) * input.rounding;
  expect_told(told(polygon + " --thickness 400"),
              judge_knot(*variant, thick, input.animation->frame(0), blur));
  expect_told(told(polygon + " --ropelength 9"),
              judge_knot(*variant, roped, input.animation->frame(0), blur));
  EXPECT_NE(run("knots " + polygon + " --thickness 400").output.find("far.csv: 1 label"), std::string::npos)
      << run("knots " + polygon + " --thickness 400").output;
  for (const std::string number : {"--ropelength 9", "--thickness 9", "--knot 3_1"})
    expect_refused("knots " + number, "a published number needs the polygon that it is of");
  expect_says("knots " + polygon, 2, {"say what was published of it"});
  expect_refused("knots --n 32 --thickness 400 " + polygon, "an input has vertices of its own");
  expect_refused("knots --n 2e6", "--n must be at most 2^20");
}

}  // namespace
}  // namespace catena::bench

#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/bench/margins/margins.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"
#include "catena/core/periodic/periodic.h"

namespace catena::bench {
namespace {

/// `catena margins`, held against what it shows.
class MarginsProgram : public Program {
 protected:
  std::vector<nlohmann::json> lines(const std::string& arguments) const {
    std::vector<nlohmann::json> all;
    std::istringstream text(run("margins " + arguments + " --json").output);
    for (std::string line; std::getline(text, line);)
      if (line.starts_with('{')) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  static void expect_shown(const nlohmann::json& line, const Margins& m) {
    EXPECT_EQ(line["pairs"], m.colliding.pairs);
    EXPECT_EQ(line["colliding_decades"], nlohmann::json(m.colliding.decade));
    EXPECT_EQ(line["apart_decades"], nlohmann::json(m.apart.decade));
    EXPECT_EQ(line["touching"], m.touching);
    EXPECT_EQ(line["open_in_binary32"], m.open_in_binary32);
    EXPECT_EQ(line["open_in_binary64"], m.open_in_binary64);
    EXPECT_EQ(line["rounding"], m.rounding);
    EXPECT_EQ(line["open_by_rounding"], m.open_by_rounding);
    ASSERT_EQ(line.contains("least_margin"), std::isfinite(m.least));
    if (!std::isfinite(m.least)) return;
    EXPECT_EQ(line["least_margin"], m.least);
    EXPECT_EQ(line["tightest"], (nlohmann::json{m.tightest.i, m.tightest.j}));
    EXPECT_EQ(line["tightest_collides"], m.tightest_collides);
    EXPECT_EQ(line["condition_number"],
              m.least == 0 ? nlohmann::json("infinite") : nlohmann::json(1 / m.least));
  }
};

TEST_F(MarginsProgram, TellsWhatIsThere) {
  for (const std::string spec : {"yarn:n=600", "lattice:n=600", "grazing:n=600,margin=1e-7", "rod:n=3"})
    expect_shown(lines(spec).at(0), margins_of(open_input(spec).animation->frame(0)));
}

/// A pair of margin 2^-50 is open in both, and touches not.
TEST_F(MarginsProgram, TellsWhatNearlyTouches) {
  const std::string near = write("near.csv", "x,y,z,r\n0,0,0,1\n50,0,0,0\n1,0,0,4.440892098500626e-16\n");
  expect_shown(lines(near).at(0), margins_of(open_input(file("near.csv")).animation->frame(0)));
  EXPECT_EQ(lines(near).at(0)["open_in_binary64"], 1);
  EXPECT_EQ(lines(near).at(0)["touching"], 0);
}

/// What reading has cost is of the file, the box of the frame.
TEST_F(MarginsProgram, TellsWhatRoundingLeavesOpenAndTheBoxOfEachFrame) {
  const std::string far =
      write("far.csv", "x,y,z,r\n100000000.3,0,0,3\n50,0,0,0\n100000010.7,0,0,3\n7,0,0,0\n100000005,0,0,3\n");
  const Input input = open_input(file("far.csv"));
  ASSERT_GT(input.rounding, 0.2);
  const Margins rounded = margins_of(input.animation->frame(0), input.rounding);
  ASSERT_NE(rounded.open_by_rounding, rounded.open_in_binary32);
  expect_shown(lines(far).at(0), rounded);
  const auto frame = [](const char* edge) {
    return std::string("3\nLattice=\"") + edge + " 0 0 0 9 0 0 0 9\"\nC 0 0 0\nC 3.5 4 0\nC 7 0 0\n";
  };
  const std::string boxes = write("boxes.xyz", frame("8") + frame("20"));
  InputOptions options{.takes_box = true};
  options.radius = 1;
  const Input moving = open_input(file("boxes.xyz"), options);
  const auto told = lines(boxes + " --radius 1 --frame all");
  ASSERT_EQ(told.size(), 2u);
  for (std::uint32_t f = 0; f < 2; ++f) {
    EXPECT_EQ(told[f]["frame"], f);
    EXPECT_EQ(told[f]["box"], written(*box_of(moving.boxes, f)));
    expect_shown(told[f], margins_of(moving.animation->frame(f), 0, box_of(moving.boxes, f)));
  }
  EXPECT_NE(told[0]["pairs"], told[1]["pairs"]);
}

TEST_F(MarginsProgram, ShowsThePowersOfTenThatHavePairs) {
  expect_says("margins rod:n=3", 0, {"no pair has a margin below 1\n"});
  expect_says("margins collinear:n=9", 0,
              {"; 7 touch exactly\n", "\n  below 1e-15                   7            0\n"});
  const std::string csv = write("a.csv", "x,y,z,r\n0,0,0,1\n50,0,0,0\n1,0,0,1\n90,0,0,0\n3.002,0,0,1\n");
  // |1 - 4| / 4 and |2.002^2 - 4| / 4
  expect_says(
      "margins " + csv, 0,
      {"smallest margin 2.001e-03: spheres 2 and 4, apart; condition number 4.997e+02\n",
       "\n  1e-01 to 1                    1            0\n  1e-03 to 1e-02                0            1\n"});
}

}  // namespace
}  // namespace catena::bench

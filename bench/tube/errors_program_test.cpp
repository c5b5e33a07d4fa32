#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "catena/bench/tube/contacts.h"
#include "catena/bench/tube/errors_line.h"
#include "catena/core/commands/test_program.h"

namespace catena::bench {
namespace {

TEST(ErrorsLine, SaysEachNumberUnderItsName) {
  TubeErrors errors{"a", 1.5, {7, 0.5, 0.25, 0.125, 1.25, 9, 2, 3, 4, 0.75, 0.375}, {}};
  const std::string of_tube =
      R"({"tube":"a","n":7,"spacing":0.5,"gap":0.25,"volume_deficit":0.125,"covering_radius":1.25,"contacts":9,)"
      R"("missed":2,"invented":3,"missed_by_covering":4,"depth_error":0.75,"covering_depth_error":0.375)";
  EXPECT_EQ(to_json(errors).dump(), of_tube + "}");
  errors.storage = StorageError{11, 5, 0.0625, {1, 2}};
  const std::string stored = of_tube + R"(,"stored":{"offset":1.5,"pairs":11,"flips":5)";
  EXPECT_EQ(to_json(errors).dump(),
            stored + R"(,"least_margin":0.0625,"condition_number":16.0,"margin_decades":[1,2]}})");
  errors.storage->least_margin = 0;  // of a tie: no number is its inverse
  EXPECT_EQ(to_json(errors).dump(),
            stored + R"(,"least_margin":0.0,"condition_number":"infinite","margin_decades":[1,2]}})");
  errors.storage->least_margin = std::numeric_limits<double>::infinity();  // no pair is near
  EXPECT_EQ(to_json(errors).dump(),
            stored + R"(,"least_margin":"infinite","condition_number":0.0,"margin_decades":[1,2]}})");
}

class ErrorsProgram : public Program {};

TEST_F(ErrorsProgram, TellsTheErrorsOfTheTubesSizesAndOffsetThatAreAsked) {
  Texts expected;
  for (const char* name : {"helix", "straight_rod"}) {
    const Tube tube = tubes_named({name}).front();
    const auto all = approaches(tube);
    for (const std::uint32_t n : {100u, 900u})
      expected.push_back(to_json(errors_of(tube, all, n, 1e6)).dump());
  }
  const ProgramOutcome told = run("errors helix straight_rod --n 100 --n 900 --offset 1e6 --json");
  EXPECT_EQ(told.code, 0);
  EXPECT_EQ(lines_of(told.output), expected);
}

TEST_F(ErrorsProgram, TakesSpacingsOverThreeDecadesWhereNoSizeIsAsked) {
  for (const auto& [name, more] : {std::pair("straight_rod", 1), {"torus_knot_2_3", 0}}) {
    const Texts lines = lines_of(run(fmt::format("errors {} --json", name)).output);
    const double length = tubes_named({name}).front().length;
    ASSERT_EQ(lines.size(), 10u);
    EXPECT_EQ(nlohmann::json::parse(lines[0])["n"], std::ceil(length) + more) << name;
    EXPECT_EQ(nlohmann::json::parse(lines[9])["n"], std::ceil(length / 0.001) + more) << name;
  }
  std::string names;
  for (const std::string& line : lines_of(run("errors --n 8 --json").output))
    names += nlohmann::json::parse(line)["tube"].get<std::string>() + " ";
  EXPECT_EQ(names, fmt::format("{} ", fmt::join(known_tubes(), " ")));
}

TEST_F(ErrorsProgram, HasARowForEachSize) {
  for (const char* name : {"straight_rod", "torus_knot_2_3", "lissajous"}) {
    const Tube tube = tubes_named({name}).front();
    const auto all = approaches(tube), touching = contacts(tube, all);
    double deepest = 0;
    for (const Approach& a : touching) deepest = std::max(deepest, a.depth(1));
    const Texts lines = lines_of(run(fmt::format("errors {} --n 60 --n 9000 --offset 1e5", name)).output);
    ASSERT_EQ(lines.size(), 5u);
    EXPECT_EQ(lines[0],
              fmt::format("{}: {:.6g} radii long, {} contact regions, the deepest {:.6g}; {} near misses",
                          name, tube.length, touching.size(), deepest, all.size() - touching.size()));
    for (const auto& [at, n] : {std::pair(3u, 60u), {4u, 9000u}}) {
      const auto [tube_name, offset, e, s] = errors_of(tube, all, n, 1e5);
      Texts row{std::to_string(n)};
      row.push_back(fmt::format("{:.4g}", e.spacing));
      for (const double value : {e.gap, e.volume_deficit, e.depth_error})
        row.push_back(fmt::format("{:.3e}", value));
      row.push_back(std::to_string(e.missed));
      row.push_back(fmt::format("{:.3e}", e.covering_depth_error));
      row.push_back(std::to_string(e.invented));
      row.push_back(s ? std::to_string(s->pairs) : "-");
      row.push_back(s ? std::to_string(s->flips) : "-");
      row.push_back(s ? fmt::format("{:.2e}", s->least_margin) : "-");
      EXPECT_EQ(words_of(lines[at]), row) << name;
    }
  }
}

TEST_F(ErrorsProgram, RefusesWhatItDoesNotKnow) {
  expect_refused("errors helix no_such", "no tube is named 'no_such'; there are: straight_rod, helix, ");
  for (const char* bad : {"1e31", "-1e31", "nan", "inf"})
    expect_refused(fmt::format("errors helix --n 60 --offset {}", bad), "--offset");
  expect_refused("errors helix --n 7", "--n");
}

}  // namespace
}  // namespace catena::bench

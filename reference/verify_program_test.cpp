#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/core/commands/test_program.h"
#include "catena/core/input/input.h"
#include "catena/reference/reference.h"

namespace catena::reference {
namespace {

/// `catena verify`, row by row.
class VerifyProgram : public Program {
 protected:
  std::map<std::string, nlohmann::json> rows(const std::string& options) const {
    const ProgramOutcome told = run("verify " + options + " --json");
    EXPECT_EQ(told.code, 0) << told.output;
    std::map<std::string, nlohmann::json> found;
    std::istringstream lines(told.output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('{')) {
        const auto row = nlohmann::json::parse(line);
        found[row["variant"]] = row;
      }
    return found;
  }
};

/// A rounded arithmetic proves nothing and is compared, however it is asked.
TEST_F(VerifyProgram, CertifiesWhatIsExact) {
  const std::string scene = "coincident:n=60";
  const auto pairs = find(open_input(scene).animation->frame(0)).pair_count;
  ASSERT_GT(pairs, 0u);
  const auto found =
      rows(scene + " --certify --variant aCPU2+CPU2 --variant aCPU2+CPU2/literal --variant CPU1");
  ASSERT_EQ(found.size(), 3u);
  for (const auto& [variant, row] : found) {
    EXPECT_EQ(row["exact_pairs"], pairs) << row;
    EXPECT_EQ(row["n"], 60) << row;
  }
  const auto& proved = found.at("aCPU2+CPU2");
  EXPECT_EQ(proved["certificate"]["holds"], true) << proved;
  EXPECT_EQ(proved["verdict"], "exact") << proved;
  EXPECT_FALSE(found.at("aCPU2+CPU2/literal").contains("certificate"));
}

/// Want of memory is nobody's fault; a wrong answer beside it leads.
TEST_F(VerifyProgram, EndsAsWhatCouldNotBeMeasuredWhereMemoryLacks) {
  const std::string starved = "path1:n=100 --variant CPU1 --variant fault:has-no-memory-past-8-spheres";
  expect_says("verify " + starved, 2,
              {"Not decided on every input: fault:has-no-memory-past-8-spheres\n",
               "Every other exact variant is exact, on 1 input: CPU1\n", "undecided: out of memory",
               "catena: 1 answer not decided"});
  expect_says("verify " + starved + " --variant mutant:throws-past-32-spheres", 1,
              {"exact variant is exact. Wrong: mutant:throws-past-32-spheres\n", "undecided: out of memory"});
  expect_says("stability " + starved, 2, {"undecided", "catena: 1 answer not decided"});
}

TEST_F(VerifyProgram, AsksAVariantOnceHoweverOftenItIsNamed) {
  expect_says("verify path1:n=50 --variant CPU1 --variant CPU1", 0, {"\n1 exact\n"});
}

/// Every frame by its number, and what is said of a file when it is read.
TEST_F(VerifyProgram, NamesFramesAndWarns) {
  std::istringstream lines(run("verify path1:n=60 --frame all --variant CPU1 --json").output);
  std::size_t frame = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('{')) {
      EXPECT_EQ(nlohmann::json::parse(line)["frame"], frame++);
    }
  EXPECT_EQ(frame, open_input("path1:n=60").animation->frames());
  const std::string file = write("a.csv", "x,y,z,r,colour\n0,0,0,1,5\n1,0,0,1,6\n2,0,0,1,7\n");
  expect_says("verify " + file + " --variant CPU1", 0, {"colour"});
}

}  // namespace
}  // namespace catena::reference

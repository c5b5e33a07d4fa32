// The command report in this process: what it takes, how often it measures, and what it keeps at Ctrl-C.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "catena/core/commands/command.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/error.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/reports/test_run_file.h"

namespace catena::reports {
namespace {

/// The command report with these options. Throws InputError for what it does not take.
std::unique_ptr<Command> with_options(const std::string& arguments) {
  const auto commands = CommandRegistry::instance().commands();
  auto command = std::ranges::find(commands, "report", &CommandInfo::name)->make();
  std::istringstream words(arguments);
  parse_options({std::istream_iterator<std::string>(words), {}},
                [&](OptionParser& app) { command->configure(app); });
  return command;
}

int report(const std::string& arguments) { return with_options(arguments)->run(); }

/// The files of a folder, but for the list of its reports.
std::set<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  names.erase(".catena-report");
  return names;
}

TEST_F(RunFile, KeepsWhatWasMeasuredAtCtrlC) {
  const std::filesystem::path folder = testing::TempDir() + "catena_interrupted_" + std::to_string(getpid());
  std::filesystem::remove_all(folder);
  const pid_t child = fork();
  if (child == 0) {
    std::freopen("/dev/null", "w", stderr);
    report("--scene path1:n=100 --variant aCPU2+CPU2 --seconds 3 --repetitions 9999 --no-page --output " +
           folder.string());
    _exit(0);
  }
  const auto rows = [&] {
    std::ifstream in(folder / "run.journal");
    std::size_t found = 0;
    for (std::string line; std::getline(in, line);) found += line.starts_with(R"({"row")");
    return found;
  };
  for (int wait = 0; wait < 3000 && rows() < 20; ++wait) usleep(10'000);
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) << status;
  EXPECT_EQ(files_in(folder), std::set<std::string>{"run.journal"});
  const std::size_t kept = rows();
  ASSERT_GE(kept, 20u);

  EXPECT_THROW(report("--scene path1:n=100 --no-page --output " + folder.string()), InputError)
      << "would lose it";
  EXPECT_THROW(with_options("--resume --seed 3 --output " + folder.string()), InputError)
      << "its options are known";
  EXPECT_EQ(report("--resume --output " + folder.string()), 0);
  EXPECT_EQ(files_in(folder), std::set<std::string>{"run.json"});
  std::ifstream in(folder / "run.json");
  const Json run = Json::parse(in);
  EXPECT_GE(run["benchmarks"].size(), kept);
  EXPECT_NE(run["catena"]["command"].get<std::string>().find("--repetitions 9999"), std::string::npos);
  EXPECT_THROW(report("--resume --output " + folder.string()), InputError) << "nothing is left to resume";
  std::filesystem::remove_all(folder);
}

TEST_F(RunFile, HoldsAsManyRepetitionsAsAreAskedFor) {
  const std::filesystem::path folder = testing::TempDir() + "catena_repetitions_" + std::to_string(getpid());
  EXPECT_EQ(
      report("--scene path1:n=50 --variant CPU1 --repetitions 14 --no-page --output " + folder.string()), 0);
  std::ifstream in(folder / "run.json");
  const Json run = Json::parse(in);
  std::map<std::string, int> repetitions;
  for (const Json& row : run["benchmarks"]) {
    ++repetitions[row["name"]];
    for (const char* key : {"least_ms", "load_one_ms", "load_all_ms"}) EXPECT_GT(row[key], 0) << key;
    EXPECT_LE(row["least_ms"], row["real_time"].get<double>() * (1 + 1e-9));
  }
  EXPECT_EQ(repetitions.size(), 2u);
  EXPECT_FALSE(run["catena"].contains("judged")) << "what is not about the scene asked for";
  for (const auto& [name, times] : repetitions) EXPECT_EQ(times, 14) << name;
  std::filesystem::remove_all(folder);
}

/// A variant that throws, so that the run has a fault.
class Throwing final : public Variant {
 public:
  void build(const Chain&) override { throw std::range_error("too far"); }
  void update(const Chain&, const Moved&) override {}
  void find(const Chain&, const Request&, Collisions&) override {}
  Timings timings() const override { return {}; }
};
const test::RegisterHidden<Throwing> throwing{{.name = "Throwing", .summary = "as a test asks"}};

/// In processes of their own, whose faults no other run has.
TEST_F(RunFile, OfAFaultyVariantEndsWithOneThoughItIsWritten) {
  const std::filesystem::path folder = testing::TempDir() + "catena_faulty_" + std::to_string(getpid());
  const auto ends = [&](const std::string& variants) {
    std::exit(
        report("--scene path1:n=50 --repetitions 2 --no-page " + variants + " --output " + folder.string()));
  };
  EXPECT_EXIT(ends("--variant CPU1"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(ends("--variant CPU1 --variant Throwing"), testing::ExitedWithCode(1), "too far");
  EXPECT_EQ(files_in(folder), (std::set<std::string>{"run.json", "run-1.json"}));
  std::filesystem::remove_all(folder);
}

/// As a page that holds longer ones is slow to open.
TEST_F(RunFile, HasAViewOfAChainThatIsNotTooLong) {
  const std::filesystem::path folder = testing::TempDir() + "catena_shown_" + std::to_string(getpid());
  for (const int n : {20'000, 20'001}) {
    EXPECT_EQ(report("--scene winding:n=" + std::to_string(n) +
                     " --variant aCPU2+CPU2 --repetitions 1 --no-page --output " + folder.string()),
              0);
    std::ifstream in(folder / "run.json");
    EXPECT_EQ(Json::parse(in)["catena"].contains("viewer"), n == 20'000) << n;
  }
  std::filesystem::remove_all(folder);
}

TEST(Report, RefusesWhatMakesNoSense) {
  EXPECT_THROW(report("--variant Nope"), InputError);
  EXPECT_THROW(report("--scene nope:n=3 --no-page"), InputError);
  EXPECT_THROW(report("--scene path1:n=50 --scene rod:n=0"), InputError);  // there is no page of it
  EXPECT_THROW(report("--benchmark_filter ( --no-page"), InputError);
  EXPECT_THROW(with_options("--quick --full"), InputError);
  EXPECT_THROW(with_options("--seconds -1"), InputError);
  EXPECT_THROW(with_options("--repetitions 0"), InputError);
  EXPECT_THROW(with_options("--resume --full"), InputError);
  EXPECT_THROW(with_options("--compare only_one.json"), InputError);
  EXPECT_THROW(profile_named("slow"), InputError);
}

}  // namespace
}  // namespace catena::reports

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/properties/testing/sanitized.h"
#include "catena/reports/copied_rate.h"
#include "catena/reports/test_sections.h"

/// What stands in each section of a run file, against what it is said to be. That the keys are those of
/// run_file.md run_file_test.cpp looks after.
namespace catena::reports {
namespace {

/// The input that the command names first.
std::string said_by(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
  const auto commands = CommandRegistry::instance().commands();
  const auto command = std::ranges::find(commands, arguments[1], &CommandInfo::name)->make();
  arguments.erase(arguments.begin(), arguments.begin() + 2);
  parse_options(arguments, [&](OptionParser& app) { command->configure(app); });
  testing::internal::CaptureStdout();
  EXPECT_EQ(command->run(), 0) << text;
  const std::string said = testing::internal::GetCapturedStdout();
  return said.substr(0, said.find(": "));
}

/// Of each published table the longest walks alone; chains whose pairs a formula knows; laws and knots.
TEST(Sections, OfWhatIsJudgedHaveEachPublishedNumberOnce) {
  Profile p;
  EXPECT_TRUE(section("judged", p).empty());
  p.judged_steps = 4, p.judged_side = 6, p.judged_n = 32'000, p.judged_moves = 6400;
  std::map<std::string, std::string> walks, formulas;
  std::size_t opens = 0, closed = 0, laws = 0, knots = 0, exponents = 0;
  for (const Json& row : section("judged", p)) {
    const std::string what = row["what"], published = row["published"];
    if (what.ends_with(" lattice")) {
      EXPECT_TRUE(walks.emplace(what, published).second) << what;
    }
    if (row["source"] == "closed form") {
      formulas[what] = published;
      EXPECT_TRUE(what.starts_with("pairs of " + said_by(row["command"]) + ", ")) << row["command"];
    }
    if (published == "O(n^(4/3))") {
      ++laws;
      const std::string interval = std::string(row["found"]).substr(std::string(row["found"]).find('[') + 1);
      const double low = std::stod(interval), high = std::stod(interval.substr(interval.find(", ") + 2));
      if (std::abs(high - low - 1) > 1e-2) {  // not told apart by three digits
        EXPECT_EQ(row.contains("open"), high - low > 1) << row;
        opens += high - low > 1, closed += high - low < 1;
      }
      EXPECT_EQ(row["agrees"], low <= 4.0 / 3) << row;
    }
    knots += what.starts_with("ropelength");
    exponents += what.starts_with("exponent nu");
    EXPECT_EQ(row.contains("open") || row["agrees"], true) << row;
    const std::string found = row["found"];
    if (const auto at = found.find("edges explain ");
        at != std::string::npos && !published.starts_with("at least")) {
      const std::string range = found.substr(at + 14);
      EXPECT_LT(std::stod(range), std::stod(range.substr(range.find(" to ") + 4))) << found;
    }
    if (what.starts_with("ropelength")) {
      EXPECT_EQ(published.starts_with("at least "), what.find("none") != std::string::npos) << row;
    }
  }
  EXPECT_EQ(walks["self-avoiding walks of 4 steps, cubic lattice"], "726");
  EXPECT_EQ(walks["walks without contacts of 4 steps, cubic lattice"], "534");
  EXPECT_EQ(walks["contacts of self-avoiding walks of 4 steps, square lattice"], "32");
  EXPECT_EQ(walks["self-avoiding walks of 4 steps, face-centred lattice"], "14700");
  EXPECT_EQ(walks.size(), 10u) << "five of two lattices, one of each other";
  ASSERT_EQ(formulas.size(), 3u);
  for (const bench::LatticeBox& box : {bench::LatticeBox{.side = 6, .reach = 3},
                                       {.side = 6, .reach = 4, .face_centred = true},
                                       {.side = 6, .reach = 3, .rods = true}})
    EXPECT_EQ(formulas[fmt::format("pairs of {}, {} of them exact ties", box.scene(), box.ties())],
              std::to_string(box.pairs()));
  EXPECT_EQ(laws, 9u);
  EXPECT_GT(opens, 0u);
  EXPECT_GT(closed, 0u);
  EXPECT_EQ(knots, 4u);
  EXPECT_EQ(exponents, 2u);
}

TEST(Sections, OfKeyframesCountThePairsOfEachFrame) {
  Profile p;
  p.keyframe_sizes = {100};
  const Json rows = section("keyframes", p);
  ASSERT_EQ(rows.size(), 2u);
  for (const Json& row : rows) {
    const std::string path = row["input"] == "path1/n:100" ? "path1:n=100" : "path2:n=100";
    Json pairs = Json::array();
    for (std::uint32_t f = 0; f < open_input(path).animation->frames(); ++f)
      pairs.push_back(exact_pairs(path, f));
    EXPECT_EQ(row["pairs"], pairs) << path;
  }
}

/// In bytes: what a tree over n spheres takes at least, and not what stood before.
TEST(Sections, OfMemoryHaveWhatAVariantHolds) {
  if (properties::sanitized) GTEST_SKIP() << "a sanitizer has an allocator of its own, which is not asked";
  Profile p = profile_of({"CPU1", "aCPU2+CPU2"});
  p.inputs = {{"path1:n=100000"}};
  p.most_all_pairs = 1000;
  const std::vector<std::byte> before(32 << 20, std::byte{1});
  const Json rows = section("memory", p);
  ASSERT_EQ(rows.size(), 1u) << "no comparison of all pairs on so long a chain";
  const std::int64_t least = 100'000 * 16, held = rows[0]["held_bytes"];
  EXPECT_GE(held, least);
  EXPECT_LT(held, 20 * least);
  EXPECT_GE(rows[0]["peak_bytes"].get<std::int64_t>(), least);
  EXPECT_LT(rows[0]["peak_bytes"].get<std::int64_t>(), 20 * least);
  // Millions of pairs: the answer, which the peak has and what is held has not.
  std::string table = "x,y,z,r\n";
  for (int k = 0; k < 3000; ++k) table += "0,0,0,1\n";
  const TestFile file("flood.csv", table);
  p = profile_of({"aCPU2+CPU2"});
  p.inputs = {{file.path().string()}};
  const auto answer = static_cast<std::int64_t>(sizeof(Pair) * (3000 * 2999 / 2 - 2999));
  const Json flood = section("memory", p);
  EXPECT_LT(flood[0]["held_bytes"].get<std::int64_t>(), answer / 4);
  EXPECT_GE(flood[0]["peak_bytes"].get<std::int64_t>(), answer / 2);
}

TEST(Sections, OfBandwidthCountBytesThatAreReadAndWritten) { EXPECT_EQ(copied_gb_s(3e6, 2), 3); }

TEST(Sections, OfBandwidthAreRatesOfThisMachine) {
  Profile p;
  EXPECT_TRUE(section("bandwidth", p).empty());
  p.copy_bytes = 64 << 20;
  const Json found = section("bandwidth", p);
  EXPECT_EQ(found["copied_bytes"], 64 << 20) << "read and written";
  for (const double rate : found["gb_s"]) {
    EXPECT_GT(rate, 0.1);
    EXPECT_LT(rate, 1000);
  }
  EXPECT_TRUE(found["sizes"].empty()) << "of no input";
}

/// What a page holds the searches of `steps` against.
TEST(Sections, OfBandwidthHaveCopiesAsLongAsEachChainThatIsSearched) {
  Profile p;
  p.copy_bytes = 4 << 20;
  p.inputs = {{"path1:n=3000"}, {"yarn:n=1000"}, {"path1:n=1000"}, {"path1:n=200", true}, in_box()};
  p.inputs.push_back({"path1:n=131072"});  // as long as the array that no cache is to hold
  p.long_inputs = {{"path1:n=20000"}};
  std::vector<std::size_t> sizes;
  const Json found = section("bandwidth", p);
  for (const Json& size : found["sizes"]) {
    sizes.push_back(size["copied_bytes"]);
    EXPECT_EQ(size["gb_s"].size(), 9u);
    for (const double rate : size["gb_s"]) {
      EXPECT_GT(rate, 0.1);
      EXPECT_LT(rate, 5000) << "copied, and not left out";
    }
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{32 * 4, 32 * 1000, 32 * 3000, 32 * 20'000}));
}

TEST(Sections, OfWantsHaveAllThreeOfEveryVariant) {
  Profile p = profile_of({"CPU1", "aCPU2+CPU2"});
  p.wants_inputs = {{"path1:n=300"}, {"path1:n=4000"}};
  std::multiset<std::string> asked;
  for (const Json& row : section("wants", p)) {
    asked.insert(row["input"].get<std::string>() + " " + row["variant"].get<std::string>() + " " +
                 row["want"].get<std::string>());
    EXPECT_GE(row["ms"].size(), 3u);
  }
  std::multiset<std::string> expected;
  for (const char* want : {"any", "counts", "pairs"})
    for (const char* of : {"path1/n:300 CPU1 ", "path1/n:300 aCPU2+CPU2 ", "path1/n:4000 aCPU2+CPU2 "})
      expected.insert(std::string(of) + want);
  EXPECT_EQ(asked, expected);
}

/// Says of a search what was asked for: 3 ms for pairs, 2 for counts, 1 for yes or no.
class Saying final : public Variant {
 public:
  void build(const Chain& chain) override { all_pairs_->build(chain); }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    all_pairs_->find(chain, request, found);
    said_.find_ms = request.want == Request::Want::pairs ? 3 : request.want == Request::Want::counts ? 2 : 1;
  }
  Timings timings() const override { return said_; }

 private:
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
  Timings said_;
};

const test::RegisterHidden<Saying> saying{{.name = "Saying", .summary = "says"}};

TEST(Sections, OfWantsHaveTheTimesOfWhatWasAskedFor) {
  Profile p = profile_of({"Saying"});
  p.wants_inputs = {{"path1:n=100"}};
  const std::map<std::string, double> said{{"pairs", 3}, {"counts", 2}, {"any", 1}};
  const Json rows = section("wants", p);
  ASSERT_EQ(rows.size(), 3u);
  for (const Json& row : rows)
    for (const double ms : row["ms"]) EXPECT_EQ(ms, said.at(row["want"])) << row;
}

/// Hybrid takes a thirtieth of the other's time.
TEST(Sections, OfRegretAreHeldAgainstTheQuickestOfAll) {
  Profile p = profile_of({"CPU1", "Hybrid", "auto"});
  p.regret_inputs = {{"yarn:n=3000"}};
  const Json rows = section("regret", p);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["best"], "Hybrid");
}

TEST(Sections, OfRanksAreEachNumberOfThemOnce) {
  Profile p;
  p.rank_chains = {{"yarn:n=3000", 1024}};
  const Json found = section("ranks", p);
  Json ranks = Json::array(), timed = Json::array();
  for (const Json& point : found["chains"][0]["points"]) {
    ranks.push_back(point["ranks"]);
    if (point.contains("processor_ms")) timed.push_back(point["ranks"]);
  }
  EXPECT_EQ(ranks, Json::parse("[1,2,4,8,16,32,64,256,1024]"));
  EXPECT_EQ(timed, Json::parse("[1,2,4,8,16,32,64,256]"));
  EXPECT_EQ(found["chains"][0]["n"], 3000);
}

/// Trees on the one side, comparisons of all pairs on the other; each row with its own answer.
TEST(Sections, OfSavingsSetTheRightOnesBesideEachOther) {
  Profile p = profile_of({"CPU1", "aCPU2+CPU2", "aCPU2+Dual"});
  p.short_chains = {10, 3000};
  p.wants_inputs = {{"path1:n=3000"}};
  p.coherent_inputs = {{"path1:n=3000"}};
  std::multiset<std::string> what;
  for (const Json& row : section("savings", p)) {
    what.insert(row["what"]);
    EXPECT_TRUE(row["identical"]) << row;
    if (row["what"] != "hierarchy") continue;
    const std::string reason = row["reason"];
    EXPECT_NE(reason.find(" against CPU1"), std::string::npos) << reason;
    EXPECT_NE(reason.find(": aCPU2+"), std::string::npos) << reason;
    if (row["input"] != "path1/n:3000") continue;
    EXPECT_LT(std::ranges::min(row["with_ms"].get<std::vector<double>>()),
              std::ranges::min(row["without_ms"].get<std::vector<double>>()))
        << "all pairs of a long chain take longer";
  }
  EXPECT_EQ(what, (std::multiset<std::string>{"hierarchy", "hierarchy", "pair list", "counts and pair list",
                                              "rebuild", "new build"}));
}

}  // namespace
}  // namespace catena::reports

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "catena/core/plan/omissions.h"
#include "catena/core/strategy/test_variant.h"
#include "catena/properties/testing/sanitized.h"
#include "catena/reports/test_sections.h"

/// That a row of savings says `identical` of what is, and not of what is not; and who is quickest.
namespace catena::reports {
namespace {

/// A tree that answers rightly but where a test asks it not to.
class Fickle final : public Variant {
 public:
  enum class Fault { none, slow, all, counts, any, update, second };
  static inline Fault fault = Fault::none;
  static inline int made = 0;

  Fickle() : number_(made++) {}
  void build(const Chain& chain) override {
    updated_ = false;
    tree_->build(chain);
  }
  void update(const Chain& chain, const Moved& moved) override {
    updated_ = !updated_;
    tree_->update(chain, moved);
  }
  void find(const Chain& chain, const Request& request, Collisions& found) override {
    if (fault == Fault::slow) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    tree_->find(chain, request, found);
    using enum Request::Want;
    if (fault == Fault::counts && request.want == counts) ++found.count[0];
    if (fault == Fault::any && request.want == any) found.found = !found.found;
    const bool lose = fault == Fault::all || (fault == Fault::update && updated_) ||
                      (fault == Fault::second && number_ % 2 == 1);
    if (lose && request.want == pairs) found.pairs.pop_back();
  }
  Timings timings() const override { return tree_->timings(); }

 private:
  std::unique_ptr<Variant> tree_ = StrategyRegistry::instance().make("aCPU2+CPU2");
  const int number_;
  bool updated_ = false;  ///< an odd number of times since the build
};

const test::RegisterHidden<Fickle> fickle{{.name = "Fickle", .summary = "as a test asks", .has_tree = true}};

/// Of a fault: the rows that are not identical.
std::set<std::string> differing(Fickle::Fault fault) {
  Profile p = profile_of({"CPU1", "Fickle"});
  p.wants_inputs = p.coherent_inputs = {{"winding:n=300"}};
  p.short_chains = {1000};
  Fickle::fault = fault;
  std::set<std::string> found, all;
  for (const std::string what : {"hierarchy", "lists", "builds"}) {
    Profile one = p;  // so that each begins with the first of them that is made
    if (what != "hierarchy") one.short_chains.clear();
    if (what != "lists") one.wants_inputs.clear();
    if (what != "builds") one.coherent_inputs.clear();
    Fickle::made = 0;
    for (const Json& row : section("savings", one)) {
      all.insert(row["what"]);
      if (row["identical"] == false) found.insert(row["what"]);
    }
  }
  Fickle::fault = Fickle::Fault::none;
  EXPECT_EQ(
      all, (std::set<std::string>{"hierarchy", "pair list", "counts and pair list", "rebuild", "new build"}));
  return found;
}

TEST(Sections, OfSavingsSayWhereTheAnswerIsAnother) {
  using enum Fickle::Fault;
  using Rows = std::set<std::string>;
  EXPECT_EQ(differing(none), Rows{});
  EXPECT_EQ(differing(all), (Rows{"hierarchy"}));
  EXPECT_EQ(differing(counts), (Rows{"pair list"}));
  EXPECT_EQ(differing(any), (Rows{"counts and pair list"}));
  EXPECT_EQ(differing(second), (Rows{"new build"}));
  EXPECT_TRUE(differing(update).contains("rebuild"));
}

TEST(Sections, OfSavingsAreOfTheQuickestTree) {
  differing(Fickle::Fault::none);  // registers it
  Profile p = profile_of({"CPU1", "Fickle", "aCPU2+CPU2"});
  p.short_chains = {200};
  Fickle::fault = Fickle::Fault::slow;
  const Json rows = section("savings", p);
  Fickle::fault = Fickle::Fault::none;
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["reason"], "200 spheres: aCPU2+CPU2 against CPU1");
}

/// Each step that auto leaves out stands once, under the first task that lets it, beside what it takes to do
/// it.
TEST(Sections, OfSavingsHaveWhatAutoLeavesOutByWhatLetsIt) {
  if (properties::sanitized) GTEST_SKIP() << "who is the quickest, and so goes on, is another there";
  Profile p = profile_of({"CPU1"});
  p.planned_inputs = {"path1:n=20", "path1:n=3000"};
  EXPECT_TRUE(section("savings", p).empty()) << "without auto";
  p = profile_of({"auto"});
  p.planned_inputs = {"path1:n=20", "path1:n=3000"};
  const std::map<std::string, std::string> tasks{
      {"pair-list", ", only counts"},          {"after-hit", ", only yes or no"},
      {"unmoved", ", unmoved frames"},         {"still-parts", ", a hundredth moved"},
      {"far-pairs", ", shaken by 0.02 radii"}, {"shifted", ", the next frame"}};
  std::set<std::string> of_few, of_many;
  for (const Json& row : section("savings", p)) {
    const std::string reason = row["reason"], last = reason.substr(reason.rfind(' ') + 1);
    const std::string name = last.substr(0, last.size() - 1);
    const auto omission = std::ranges::find(all_omissions(), name, &OmissionInfo::name);
    ASSERT_NE(omission, all_omissions().end()) << reason;
    // Whether it pays to search the moved parts alone, so that nothing is built, is measured.
    if (name == "hierarchy" && row["input"] != "path1/n:20") continue;
    EXPECT_EQ(row["what"], omission->step + (tasks.contains(name) ? tasks.at(name) : "")) << reason;
    EXPECT_TRUE(reason.ends_with(" (--no-omit " + name + ")")) << reason;
    EXPECT_TRUE(row["identical"]) << row;
    EXPECT_TRUE((row["input"] == "path1/n:20" ? of_few : of_many).insert(name).second) << row;
    if (name == "still-parts") {
      EXPECT_LE(std::stoul(reason), 3000u / 50) << "parts of a few spheres";
    }
    if (name == "unmoved") {
      EXPECT_LT(std::ranges::min(row["without_ms"].get<std::vector<double>>()),
                std::ranges::min(row["with_ms"].get<std::vector<double>>()));
    }
  }
  EXPECT_TRUE(of_few.contains("hierarchy"));
  EXPECT_FALSE(of_many.contains("sort")) << "in the chain's order";
  // And so "still-parts" may be missing.
  for (const char* name : {"pair-list", "after-hit", "unmoved", "shifted", "exact"})
    EXPECT_TRUE(of_many.contains(name)) << name;
}

}  // namespace
}  // namespace catena::reports

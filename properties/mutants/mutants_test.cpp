#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/thrown.h"
#include "catena/properties/giants.h"
#include "catena/properties/mutants/chains_to_kill.h"
#include "catena/properties/mutants/counted_for.h"
#include "catena/properties/property.h"

// The tests are tested: every mutant in the museum must be killed by a property, and the bases that they
// are made from must pass all of them, so that it is the bug that kills.
namespace catena::properties {
namespace {

using testing::NamedChain;

/// The cases, made once for all mutants when they are first needed.
class Cases {
 public:
  std::size_t size() const { return named_.chains.size(); }
  std::size_t small() const { return named_.small; }
  const std::string& name(std::size_t k) const { return named_.chains[k].name; }
  const Case& operator[](std::size_t k) {
    while (cases_.size() <= k)
      cases_.push_back(std::make_unique<Case>(Case::of(named_.chains[cases_.size()].chain)));
    return *cases_[k];
  }

 private:
  testing::ChainsToKill named_ = testing::chains_to_kill();
  std::vector<std::unique_ptr<Case>> cases_;
};

Cases& cases() {
  static Cases all;
  return all;
}

/// What is wrong with the variant on a case, by one property.
std::optional<std::string> failure(Property& property, const Subject& subject, Variant& variant,
                                   const Case& test) {
  try {
    return property.check(subject, variant, test);
  } catch (const CapacityError&) {
    return std::nullopt;  // a refusal within a declared limit
  } catch (...) {
    return "threw: " + thrown_words();
  }
}

/// property -> number of cases it took to see that something is wrong.
using Kills = std::map<std::string, std::size_t>;

/// Runs every property on the small cases until so many have killed, then on the others until one kills, then
/// what is asked of every chain on the giants.
Kills kill(const Subject& subject) {
  const CountedFor counted(subject.info.name);
  Kills kills;
  struct Run {
    std::unique_ptr<Property> property;
    std::unique_ptr<Variant> variant;
  };
  std::vector<Run> runs;
  for (auto& property : PropertyRegistry::instance().make_all())
    if (property->applies_to(subject)) runs.push_back({std::move(property), subject.make()});
  constexpr std::size_t many = 6;  // more say nothing new of the mutant, and little of the properties
  for (std::size_t k = 0; k < cases().size() && (k < cases().small() ? kills.size() < many : kills.empty());
       ++k)
    for (const Run& run : runs)
      if (!kills.contains(run.property->name()) && failure(*run.property, subject, *run.variant, cases()[k]))
        kills[run.property->name()] = k + 1;
  for (std::size_t k = 0; k < giants().size() && kills.empty(); ++k)
    for (const Run& run : runs)
      if (run.property->every_chain() && failure(*run.property, subject, *run.variant, giants()[k]))
        kills[run.property->name()] = cases().size() + k + 1;
  return kills;
}

std::vector<Subject> hidden(std::string_view prefix) {
  auto all = Subject::available(true);
  std::erase_if(all, [&](const Subject& s) { return !s.info.hidden || !s.info.name.starts_with(prefix); });
  return all;
}
std::vector<Subject> mutants() { return hidden("mutant:"); }

void print_row(const Subject& mutant, const Kills& kills) {
  std::vector<std::pair<std::size_t, std::string>> in_order;
  for (const auto& [property, after] : kills) in_order.emplace_back(after, property);
  std::ranges::sort(in_order);
  std::string by;
  for (const auto& [after, property] : in_order)
    by += fmt::format("{}{} ({})", by.empty() ? "" : ", ", property, after);
  fmt::print("{:<36}  {}\n", mutant.info.name, by.empty() ? "SURVIVES" : by);
}

TEST(Mutants, TheMuseumIsLarge) {
  EXPECT_GE(mutants().size(), 25u);
  for (const Subject& mutant : mutants()) {
    EXPECT_FALSE(mutant.info.summary.empty()) << mutant.info.name;
    EXPECT_TRUE(mutant.exact()) << mutant.info.name << ": rounding would excuse it";
  }
}

TEST(Mutants, AreHiddenFromEveryList) {
  const auto expect_none = [](const std::string& name) {
    EXPECT_FALSE(name.starts_with("mutant:") || name.starts_with("base:")) << name;
  };
  for (const auto& info : StrategyRegistry::instance().variants()) expect_none(info.name);
  for (const auto& name : StrategyRegistry::instance().strategy_names()) expect_none(name);
}

/// Holds every base to every property on cases begin to end - 1, and what is asked of every chain on
/// `giants`.
void expect_bases_pass(std::size_t begin, std::size_t end, std::span<const Case> giants = {}) {
  const auto bases = hidden("base:");
  EXPECT_GE(bases.size(), 20u);
  for (const auto& property : PropertyRegistry::instance().make_all()) {
    std::vector<std::unique_ptr<Variant>> variants;
    for (const Subject& base : bases) variants.push_back(property->applies_to(base) ? base.make() : nullptr);
    const auto expect_holds = [&](const Case& test, const std::string& name) {
      for (std::size_t b = 0; b < bases.size(); ++b) {
        if (!variants[b]) continue;
        const auto what = failure(*property, bases[b], *variants[b], test);
        EXPECT_FALSE(what) << bases[b].info.name << ": " << property->name() << " on " << name
                           << ", n = " << test.chain.size() << ": " << *what;
      }
    };
    for (std::size_t k = begin; k < end; ++k) expect_holds(cases()[k], cases().name(k));
    if (!property->every_chain()) continue;
    for (const Case& giant : giants) expect_holds(giant, "a giant");
  }
}

TEST(Mutants, WithoutABugTheirBasePasses) { expect_bases_pass(0, cases().small()); }
TEST(Mutants, WithoutABugTheirBasePassesLongChains) {
  expect_bases_pass(cases().small(), cases().size(), giants());
}

TEST(Mutants, AllDie) {
  std::set<std::string> idle;
  for (const auto& property : PropertyRegistry::instance().make_all()) idle.insert(property->name());
  fmt::print("{:<36}  killed by (after that many chains)\n", "mutant");
  for (const Subject& mutant : mutants()) {
    const Kills kills = kill(mutant);
    print_row(mutant, kills);
    EXPECT_FALSE(kills.empty()) << mutant.info.name << " survives: " << mutant.info.summary;
    EXPECT_EQ(kills.contains("no allocation once warm"), allocating_mutants().contains(mutant.info.name))
        << mutant.info.name;
    for (const auto& [property, after] : kills) idle.erase(property);
  }
  for (const auto& property : idle) ADD_FAILURE() << "'" << property << "' kills no mutant: is it needed?";
}

}  // namespace
}  // namespace catena::properties

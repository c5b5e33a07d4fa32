#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "catena/core/readers/chain_format.h"
#include "catena/properties/declared_limit.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/giants.h"
#include "catena/properties/suite.h"
#include "catena/properties/variant_name.h"
#include "catena/reference/reference.h"

/// Every property on every registered variant over every family of chains; a test a variant, so that a
/// failure names it. Device variants are a suite of their own: `ctest -L gpu`.
namespace catena::properties {
namespace {

/// Of each family. A device takes a hundred times as long for a short chain, and several processes share it.
std::uint32_t rounds_for(const Subject& subject) { return subject.info.on_device() ? 6 : 20; }

std::vector<Subject> all_subjects() {
  std::vector<Subject> subjects;
  for (const VariantInfo& info : StrategyRegistry::instance().variants())
    subjects.push_back(Subject::of(info));
  for (Subject& small : in_small_blocks(subjects))
    if (small.exact()) subjects.push_back(std::move(small));
  return subjects;
}

std::vector<Subject> subjects(bool on_device) {
  auto all = all_subjects();
  std::erase_if(all, [&](const Subject& s) { return s.info.on_device() != on_device; });
  return all;
}

std::string test_name(const testing::TestParamInfo<Subject>& info) {
  std::string name = info.param.info.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

/// Short chains, but for a few that reach the limits of blocks: there n is what matters.
std::uint32_t size_of(const Family& family, std::uint32_t round) {
  return family.name == "sizes" && round < 5 ? 2400 : 48;
}

/// The finding with its shrunk chain.
std::string explain(const Suite& suite, const Finding& finding, const Chain& chain) {
  const Chain simple = shrink(chain, [&](const Chain& c) { return suite.repeats(finding, c); });
  std::ostringstream text;
  text << finding.variant << ": " << finding.property << ": " << finding.what << "\nshrunk:\n";
  write_chain(text, simple);
  return text.str();
}

/// `refused` of the checks on a chain of n spheres were refused: none, but for a declared limit, and some
/// past it.
void expect_refusals(const std::optional<DeclaredLimit>& limit, std::uint32_t n, std::uint64_t refused) {
  if (!may_refuse(limit, n)) {
    EXPECT_EQ(refused, 0u) << "refuses " << n << " spheres, which it declares to take";
  } else if (n <= limit->takes) {
    EXPECT_LE(refused, 1u) << "only subdivision asks of more than " << n << " spheres";
  } else if (n > limit->refuses_past) {
    EXPECT_GT(refused, 0u) << "takes " << n << " spheres, which is past its declared limit";
  }
}

class Variants : public testing::TestWithParam<Subject> {};

TEST_P(Variants, HoldEveryPropertyOnEveryFamily) {
  const Subject& subject = GetParam();
  if (subject.info.unavailable) GTEST_SKIP() << *subject.info.unavailable;
  Suite suite({subject});
  const auto limit = declared_limit(subject);
  std::uint64_t seed = 0, taken = 0;
  for (const Family& family : FamilyRegistry::instance().families())
    for (std::uint32_t round = 0; round < rounds_for(subject); ++round) {
      Dice dice(++seed);
      const Case test = Case::of(generate(family, dice, size_of(family, round)));
      const std::uint64_t refused_before = suite.tally().refusals;
      if (const auto finding = suite.check(test)) {
        ADD_FAILURE() << family.name << ", seed " << seed << ": " << explain(suite, *finding, test.chain);
        break;
      }
      const std::uint64_t refused = suite.tally().refusals - refused_before;
      expect_refusals(limit, test.chain.size(), refused);
      taken += refused == 0;
    }
  for (const Case& giant : giants())
    if (const auto finding = suite.check_always(giant))
      ADD_FAILURE() << giant.chain.size() << " spheres: " << finding->property << ": " << finding->what;
  const auto& tally = suite.tally();
  EXPECT_GT(tally.checks, tally.chains);
  EXPECT_GT(20 * taken, rounds_for(subject) * FamilyRegistry::instance().families().size())
      << "refuses too much to be tested";
  RecordProperty("checks", static_cast<int>(tally.checks));
}

INSTANTIATE_TEST_SUITE_P(Host, Variants, testing::ValuesIn(subjects(false)), test_name);
INSTANTIATE_TEST_SUITE_P(Device, Variants, testing::ValuesIn(subjects(true)), test_name);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Variants);

}  // namespace

/// How gtest names a subject where it prints one.
void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.info.name; }

}  // namespace catena::properties

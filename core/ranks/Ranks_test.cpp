#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "catena/core/readers/chain_format.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/generators/simplifications.h"
#include "catena/properties/giants.h"
#include "catena/properties/suite.h"

/// The search by ranks is one more exact variant: every property on every family of chains, by ranks that are
/// threads, few and many, even and uneven, in chain order and by space, in one round and in as many as there
/// are blocks.
namespace catena::properties {
namespace {

class RanksProperties : public testing::TestWithParam<std::string> {};

TEST_P(RanksProperties, HoldOnEveryFamily) {
  Suite suite({Subject::named(GetParam())});
  std::uint64_t seed = 1000;
  for (const Family& family : FamilyRegistry::instance().families())
    for (std::uint32_t round = 0; round < 1; ++round) {
      Dice dice(++seed);
      const Case test = Case::of(generate(family, dice, family.name == "sizes" && round == 0 ? 2400 : 48));
      const auto finding = suite.check(test);
      if (!finding) continue;
      std::ostringstream text;
      write_chain(text, shrink(test.chain, [&](const Chain& c) { return suite.repeats(*finding, c); }));
      FAIL() << family.name << ", seed " << seed << ": " << finding->property << ": " << finding->what << '\n'
             << text.str();
    }
  for (const Case& giant : giants())
    if (const auto finding = suite.check_always(giant)) FAIL() << finding->property << ": " << finding->what;
}

INSTANTIATE_TEST_SUITE_P(Host, RanksProperties,
                         testing::Values("Ranks(ranks=1)", "Ranks(ranks=2,order=chain)", "Ranks(ranks=3)",
                                         "Ranks(ranks=3,order=space,blocks_at_once=1)",
                                         "Ranks(ranks=7,order=space,parts=uneven)",
                                         "Ranks(ranks=5,order=chain,parts=uneven,blocks_at_once=2)",
                                         "Ranks(ranks=11,order=space)"),
                         [](const auto& of) { return fmt::format("Case{}", of.index); });

}  // namespace
}  // namespace catena::properties
